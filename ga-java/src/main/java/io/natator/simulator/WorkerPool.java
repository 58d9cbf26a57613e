package io.natator.simulator;

import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import java.util.function.Consumer;

/** Carries out a batch of evaluations on a fixed number of threads. */
public final class WorkerPool implements AutoCloseable {

    private final Simulator simulator;
    private final ExecutorService workers;

    /**
     * A pool that does not own the simulator.
     *
     * @param count evaluations at the same time, at least 1
     */
    public WorkerPool(Simulator simulator, int count) {
        this.simulator = simulator;
        this.workers = Executors.newFixedThreadPool(count, task -> {
            Thread thread = new Thread(task, "evaluation");
            thread.setDaemon(true);
            return thread;
        });
    }

    /**
     * Evaluates all requests. Results are handed over on the calling thread in the order of the requests, each as soon
     * as it and all before it are there; so nothing after this point can depend on the number of workers.
     *
     * @param inOrder called once for each request
     * @throws RequestRejectedException if the simulator refuses a request; the other evaluations are abandoned
     * @throws InterruptedException     if the calling thread is interrupted; the evaluations are abandoned
     */
    public void evaluateAll(List<SimulationRequest> requests, Consumer<SimulationResult> inOrder)
            throws InterruptedException {
        List<Future<SimulationResult>> results = new ArrayList<>();
        for (SimulationRequest request : requests) {
            results.add(workers.submit(() -> simulator.evaluate(request)));
        }
        try {
            for (Future<SimulationResult> result : results) {
                inOrder.accept(result.get());
            }
        } catch (ExecutionException e) {
            if (e.getCause() instanceof RuntimeException cause) {
                throw cause;
            }
            if (e.getCause() instanceof InterruptedException) {
                throw new InterruptedException("evaluation was stopped");
            }
            throw new IllegalStateException("evaluation ended unexpectedly", e.getCause());
        } finally {
            results.forEach(result -> result.cancel(true));
        }
    }

    @Override
    public void close() {
        workers.shutdownNow();
    }
}
