package io.natator.process;

import io.natator.config.ExecutionSettings;
import io.natator.config.Json;
import io.natator.protocol.RequestRejectedException;
import io.natator.protocol.ResultReader;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import io.natator.protocol.SimulatorFailure;
import java.util.List;
import java.util.concurrent.Callable;
import java.util.concurrent.atomic.AtomicInteger;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * One native process per evaluation, as in the thesis (2.6): one JSON request on standard input, one JSON line on
 * standard output. A process that crashes, hangs or answers nonsense is tried once more; if that fails too, the
 * evaluation is recorded as failed and nothing else suffers.
 */
public final class ProcessEvaluator extends WorkerPool {

    /** How often an evaluation is tried. */
    static final int ATTEMPTS = 2;

    private static final Logger LOG = LoggerFactory.getLogger(ProcessEvaluator.class);

    private final NativeProgram program;
    private final List<List<String>> arguments;
    private final AtomicInteger started = new AtomicInteger();

    /**
     * A simulator that starts the given program for every evaluation.
     *
     * @param settings with a time limit
     */
    public ProcessEvaluator(ExecutionSettings settings) {
        super(settings.workers());
        this.program = new NativeProgram(settings.simulator(), settings.timeout());
        this.arguments = settings.devices().stream()
                .map(device -> List.of("evaluate", "--backend", settings.backend().argument(), "--device", "" + device))
                .toList();
    }

    @Override
    Callable<SimulationResult> evaluation(SimulationRequest request) {
        String input = Json.line(request) + "\n";
        return () -> {
            String reason = "";
            for (int attempt = 1; attempt <= ATTEMPTS; attempt++) {
                try {
                    return answer(request, program.call(nextArguments(), input, line -> {
                    }));
                } catch (SimulatorFailure e) {
                    reason = e.getMessage();
                    LOG.debug("evaluation {}, attempt {} of {}: {}", request.id(), attempt, ATTEMPTS, reason);
                }
            }
            return SimulationResult.failed(request.id(), reason);
        };
    }

    /** GPUs take turns. */
    private List<String> nextArguments() {
        return arguments.get(Math.floorMod(started.getAndIncrement(), arguments.size()));
    }

    private static SimulationResult answer(SimulationRequest request, NativeProgram.Output output)
            throws SimulatorFailure {
        SimulationResult result;
        try {
            result = ResultReader.read(output.text());
        } catch (SimulatorFailure e) {
            throw new SimulatorFailure(e.getMessage() + end(output), e);
        }
        if (result.status() == SimulationResult.Status.ERROR && output.exitStatus() != ExitStatus.OK) {
            throw new RequestRejectedException(result.error(), output.exitStatus() == ExitStatus.BAD_INPUT);
        }
        int expected = result.status() == SimulationResult.Status.UNSTABLE ? ExitStatus.UNSTABLE : ExitStatus.OK;
        if (result.id() == null || result.id() != request.id()) {
            throw new SimulatorFailure("no valid result: id is " + result.id() + ", not " + request.id() + end(output));
        }
        if (output.exitStatus() != expected || result.status() == SimulationResult.Status.ERROR) {
            throw new SimulatorFailure("no valid result: status " + result.status().name().toLowerCase()
                    + " with " + end(output).substring(2));
        }
        return result;
    }

    private static String end(NativeProgram.Output output) {
        return "; exit status " + output.exitStatus()
                + (output.errorText().isEmpty() ? "" : ", errors " + ResultReader.shown(output.errorText()));
    }

    @Override
    public void close() {
        super.close();
        program.close();
    }
}
