package io.natator.run;

import io.natator.evolution.EvolutionStoppedException;
import io.natator.process.Evaluator;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import java.util.concurrent.TimeUnit;
import java.util.function.Supplier;

/** Carries out many pieces of work, several at the same time with one evaluator, so that their evaluations share a batch. */
public final class Lanes {

    private Lanes() {
    }

    /** What is done as a whole, or again. */
    @FunctionalInterface
    public interface Work {

        /** Does it. */
        void run() throws InterruptedException;
    }

    /**
     * Carries out all of it, begun in this order.
     *
     * @param evaluator what the work uses; closed if a piece fails
     * @param atOnce    pieces under way at the same time, at least 1
     * @return whether all is done; false if the evaluator was closed meanwhile
     * @throws InterruptedException if the calling thread is interrupted
     */
    public static boolean carryOut(List<? extends Work> all, Evaluator evaluator, int atOnce) throws InterruptedException {
        ConcurrentLinkedQueue<Work> waiting = new ConcurrentLinkedQueue<>(all);
        ExecutorService threads = Executors.newFixedThreadPool(atOnce);
        try {
            List<Future<Boolean>> lanes = new ArrayList<>();
            for (int i = 0; i < atOnce; i++) {
                lanes.add(threads.submit(() -> work(waiting::poll, evaluator)));
            }
            boolean done = true;
            for (Future<Boolean> lane : lanes) {
                done &= lane.get();
            }
            return done;
        } catch (ExecutionException e) {
            evaluator.close();
            if (e.getCause() instanceof RuntimeException cause) {
                throw cause;
            }
            throw new IllegalStateException(e.getCause());
        } finally {
            threads.shutdown();
            threads.awaitTermination(1, TimeUnit.MINUTES);
        }
    }

    private static boolean work(Supplier<Work> waiting, Evaluator evaluator) {
        try {
            for (Work work = waiting.get(); work != null; work = waiting.get()) {
                work.run();
            }
            return true;
        } catch (EvolutionStoppedException | InterruptedException e) {
            return false;
        } catch (RuntimeException e) {
            evaluator.close();
            throw e;
        }
    }
}
