package io.natator.process;

import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import io.natator.protocol.SimulatorFailure;
import java.util.Deque;
import java.util.concurrent.Callable;
import java.util.concurrent.ConcurrentLinkedDeque;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * Native processes that stay alive, as many as evaluations were ever under way at once, each with one evaluation at a
 * time. A process that fails is replaced; its evaluation is tried once more in another one.
 */
public final class ResidentEvaluator extends WorkerPool {

    private static final Logger LOG = LoggerFactory.getLogger(ResidentEvaluator.class);

    private final ExecutionSettings settings;
    private final ServeCommands commands;
    private final ProcessGroup group = new ProcessGroup();
    private final Deque<ServeProcess> idle = new ConcurrentLinkedDeque<>();

    /**
     * A simulator without processes; they are started when they are needed.
     *
     * @param settings with a time limit
     */
    public ResidentEvaluator(ExecutionSettings settings) {
        super(settings.workers());
        this.settings = settings;
        this.commands = new ServeCommands(settings);
    }

    @Override
    Callable<SimulationResult> evaluation(SimulationRequest request) {
        String input = Json.line(request) + "\n";
        return () -> {
            String reason = "";
            ServeCommands.Command tried = null;
            for (int attempt = 1; attempt <= ProcessEvaluator.ATTEMPTS; attempt++) {
                try {
                    ServeProcess process = take(tried, request);
                    tried = process.command();
                    return attempt(process, request, input);
                } catch (SimulatorFailure e) {
                    reason = e.getMessage();
                    LOG.debug("evaluation {}, attempt {} of {}: {}", request.id(), attempt, ProcessEvaluator.ATTEMPTS,
                            reason);
                } finally {
                    group.failIfStopped();
                }
            }
            return SimulationResult.failed(request.id(), reason);
        };
    }

    private SimulationResult attempt(ServeProcess process, SimulationRequest request, String input)
            throws SimulatorFailure, InterruptedException {
        boolean reusable = false;
        try {
            process.send(input);
            SimulationResult result = process.receive(settings.timeout().toNanos());
            if (result.status() == SimulationResult.Status.ERROR) {
                throw new RequestRejectedException(result.error(), true);
            }
            if (result.id() != request.id()) {
                throw new SimulatorFailure("no valid result: id is " + result.id() + ", not " + request.id());
            }
            reusable = true;
            return result;
        } finally {
            if (reusable && !group.isStopped()) {
                idle.push(process);
            } else {
                process.close();
                commands.ended(process.command(), !reusable);
            }
        }
    }

    /** An idle process, or a new one. One that died or talks to itself while idle costs no attempt. */
    private ServeProcess take(ServeCommands.Command avoided, SimulationRequest request)
            throws SimulatorFailure, InterruptedException {
        for (ServeProcess process = idle.poll(); process != null; process = idle.poll()) {
            if (process.isReady()) {
                return process;
            }
            process.close();
            commands.ended(process.command(), true);
        }
        return commands.startAny(group, avoided, request);
    }

    @Override
    public void close() {
        super.close();
        group.close();
        for (ServeProcess process = idle.poll(); process != null; process = idle.poll()) {
            process.close();
        }
    }
}
