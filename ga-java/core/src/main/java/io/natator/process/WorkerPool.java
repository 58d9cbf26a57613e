package io.natator.process;

import io.natator.protocol.SimulationRequest;
import io.natator.protocol.SimulationResult;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.BlockingQueue;
import java.util.concurrent.Callable;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import java.util.concurrent.FutureTask;
import java.util.concurrent.LinkedBlockingQueue;
import java.util.concurrent.RejectedExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;

/** Evaluates on a fixed number of threads, one request each at a time. */
abstract class WorkerPool implements Evaluator {

    private static final long POLL_MILLISECONDS = 100;

    private final ExecutorService workers;

    /**
     * A pool whose threads are started when they are needed.
     *
     * @param count evaluations at the same time, at least 1
     */
    WorkerPool(int count) {
        workers = Executors.newFixedThreadPool(count, task -> {
            Thread thread = new Thread(task, "evaluation");
            thread.setDaemon(true);
            return thread;
        });
    }

    /**
     * One evaluation, to be carried out on a thread of the pool; interrupted when it is abandoned. What goes wrong in it alone is a result
     * with {@link SimulationResult.Status#FAILED}.
     */
    abstract Callable<SimulationResult> evaluation(SimulationRequest request);

    @Override
    public final void evaluateAll(List<SimulationRequest> requests, Consumer<SimulationResult> whenDone)
            throws InterruptedException {
        BlockingQueue<Future<SimulationResult>> finished = new LinkedBlockingQueue<>();
        List<Future<SimulationResult>> tasks = new ArrayList<>();
        try {
            for (SimulationRequest request : requests) {
                FutureTask<SimulationResult> task = new FutureTask<>(evaluation(request)) {
                    @Override
                    protected void done() {
                        finished.add(this);
                    }
                };
                tasks.add(task);
                workers.execute(task);
            }
            for (int i = 0; i < requests.size(); i++) {
                whenDone.accept(take(finished).get());
            }
        } catch (RejectedExecutionException e) {
            throw stopped(e);
        } catch (ExecutionException e) {
            if (e.getCause() instanceof RuntimeException cause) {
                throw cause;
            }
            if (e.getCause() instanceof InterruptedException) {
                throw stopped(e);
            }
            if (e.getCause() instanceof Error lacking) {
                throw lacking;
            }
            throw new IllegalStateException("evaluation ended unexpectedly", e.getCause());
        } finally {
            tasks.forEach(task -> task.cancel(true));
        }
    }

    /** What was still waiting for a worker when the pool was closed never finishes. */
    private Future<SimulationResult> take(BlockingQueue<Future<SimulationResult>> finished)
            throws InterruptedException {
        for (;;) {
            Future<SimulationResult> task = finished.poll(POLL_MILLISECONDS, TimeUnit.MILLISECONDS);
            if (workers.isShutdown()) {
                throw new InterruptedException("evaluations were stopped");
            }
            if (task != null) {
                return task;
            }
        }
    }

    private static InterruptedException stopped(Exception cause) {
        InterruptedException stopped = new InterruptedException("evaluations were stopped");
        stopped.initCause(cause);
        return stopped;
    }

    @Override
    public void close() {
        workers.shutdownNow();
    }
}
