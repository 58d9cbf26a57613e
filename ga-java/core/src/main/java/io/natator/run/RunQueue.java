package io.natator.run;

import io.natator.checkpoint.RunFolder;
import io.natator.config.ExecutionSettings;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.EvolutionListener;
import io.natator.evolution.EvolutionStoppedException;
import io.natator.simulator.Evaluator;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import java.util.concurrent.TimeUnit;
import java.util.function.Supplier;

/** Carries out many runs, several at the same time with one evaluator, so that their generations share a batch. */
public final class RunQueue {

    private final List<PlannedRun> runs;

    /** A queue in which the runs are begun in this order. */
    public RunQueue(List<PlannedRun> runs) {
        this.runs = List.copyOf(runs);
    }

    /** Follows the runs; called from several threads. */
    public interface Watcher {

        /** An evaluation has ended that was not recorded before. */
        void evaluated();

        /** A run has reached its end; its folder is still open. */
        void finished(RunFolder run, EvolutionRun.Outcome outcome);

        /** An own listener for a run that is about to begin or to continue. */
        EvolutionListener forRun();
    }

    /**
     * Carries out what is missing.
     *
     * @param execution how the evaluator works, for the record
     * @param evaluator carries out the evaluations; closed if a run fails
     * @param atOnce    runs under way at the same time, at least 1
     * @return whether all runs are finished; false if the evaluator was closed meanwhile
     * @throws InterruptedException if the calling thread is interrupted
     */
    public boolean run(ExecutionSettings execution, Evaluator evaluator, int atOnce, Watcher watcher)
            throws InterruptedException {
        ConcurrentLinkedQueue<PlannedRun> waiting = new ConcurrentLinkedQueue<>(
                runs.stream().filter(run -> !run.isFinished()).toList());
        ExecutorService threads = Executors.newFixedThreadPool(atOnce);
        try {
            List<Future<Boolean>> lanes = new ArrayList<>();
            for (int i = 0; i < atOnce; i++) {
                lanes.add(threads.submit(() -> work(waiting::poll, execution, evaluator, watcher)));
            }
            boolean all = true;
            for (Future<Boolean> lane : lanes) {
                all &= lane.get();
            }
            return all;
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

    private static boolean work(Supplier<PlannedRun> waiting, ExecutionSettings execution, Evaluator evaluator,
            Watcher watcher) throws InterruptedException {
        try {
            for (PlannedRun run = waiting.get(); run != null; run = waiting.get()) {
                carryOut(run, execution, evaluator, watcher);
            }
            return true;
        } catch (EvolutionStoppedException | InterruptedException e) {
            return false;
        } catch (RuntimeException e) {
            evaluator.close();
            throw e;
        }
    }

    private static void carryOut(PlannedRun run, ExecutionSettings execution, Evaluator evaluator, Watcher watcher)
            throws InterruptedException {
        try (RunFolder folder = run.open()) {
            int before = folder.recorded().size();
            EvolutionListener counter = new EvolutionListener() {
                @Override
                public void evaluated(EvaluationRecord evaluation) {
                    if (evaluation.result().id() >= before) {
                        watcher.evaluated();
                    }
                }
            };
            watcher.finished(folder,
                    new EvolutionRun(folder).run(execution, evaluator, counter, watcher.forRun()));
        }
    }
}
