package io.natator.process;

import io.natator.config.ExecutionSettings;
import io.natator.process.BatchJob.Call;
import io.natator.process.BatchJob.Reply;
import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.atomic.AtomicReference;
import java.util.function.Consumer;

/**
 * Gives all evaluations that wait to a native process at once, for a backend that computes many together; with several
 * GPUs or commands, to a process of each an equal share. Evaluations that several threads ask for share a batch. A GPU or
 * command that fails leaves its share to the others.
 */
public final class BatchEvaluator implements Evaluator {

    private static final long POLL_MILLISECONDS = 100;

    private final ProcessGroup group = new ProcessGroup();
    private final BatchQueue queue = new BatchQueue();
    private final List<Thread> threads = new ArrayList<>();
    /** What ended a thread that computes batches, which nobody foresaw: that memory ran out, say. */
    private final AtomicReference<Throwable> failure = new AtomicReference<>();

    /**
     * A simulator whose processes are started when they are needed.
     *
     * @param settings with a time limit, which is that of one evaluation
     */
    public BatchEvaluator(ExecutionSettings settings) {
        ServeCommands commands = new ServeCommands(settings);
        for (ServeCommands.Command command : commands.all()) {
            threads.add(new Thread(new BatchWorker(queue, commands, command, group, settings.timeout()), "batches"));
        }
        for (Thread thread : threads) {
            thread.setDaemon(true);
            thread.setUncaughtExceptionHandler((ended, reason) -> failure.compareAndSet(null, reason));
            thread.start();
        }
    }

    @Override
    public void evaluateAll(List<SimulationRequest> requests, Consumer<SimulationResult> whenDone)
            throws InterruptedException {
        Call call = new Call();
        try {
            queue.add(requests.stream().map(request -> new BatchJob(request, call)).toList());
            for (int i = 0; i < requests.size(); i++) {
                Reply reply = null;
                while (reply == null) {
                    group.failIfStopped();
                    failIfThreadFailed();
                    reply = call.replies().poll(POLL_MILLISECONDS, TimeUnit.MILLISECONDS);
                }
                if (reply.rejection() != null) {
                    throw reply.rejection();
                }
                whenDone.accept(reply.result());
            }
        } finally {
            call.abandon();
        }
    }

    /** Rethrows what ended a worker thread; its callers would block for ever. */
    private void failIfThreadFailed() {
        if (failure.get() instanceof Error lacking) {
            throw lacking;
        }
        if (failure.get() instanceof RuntimeException unforeseen) {
            throw unforeseen;
        }
    }

    @Override
    public void close() {
        group.close();
        threads.forEach(Thread::interrupt);
    }
}
