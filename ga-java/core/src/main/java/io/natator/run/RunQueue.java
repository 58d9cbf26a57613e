package io.natator.run;

import io.natator.checkpoint.RunWriter;
import io.natator.config.ExecutionSettings;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.EvolutionListener;
import io.natator.evolution.EvolutionStoppedException;
import io.natator.process.Evaluator;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.ExecutorService;
import java.util.concurrent.Executors;
import java.util.concurrent.Future;
import java.util.concurrent.TimeUnit;

/** Carries out many runs, several at the same time with one evaluator, so that their generations share a batch. */
public final class RunQueue {

    private final List<PlannedRun> runs;

    /**
     * A queue in which the runs are begun in this order. Writes nothing.
     *
     * @param simulator the native program, which knows the scenes
     * @throws io.natator.base.InvalidInputException if a scene was changed since a run in it was begun that is to go on
     */
    public RunQueue(List<PlannedRun> runs, Path simulator) throws InterruptedException {
        this.runs = List.copyOf(runs);
        for (PlannedRun run : this.runs) {
            run.checkScene(simulator);
        }
    }

    /** Follows the runs; called from several threads. */
    public interface Watcher {

        /** An evaluation has ended that was not recorded before. */
        void evaluated();

        /** A run has reached its end; its folder is still open. */
        void finished(RunWriter run, EvolutionRun.Outcome outcome);

        /** An own listener for a run that is about to begin or to continue. */
        EvolutionListener forRun();
    }

    /**
     * Carries out what is missing, or less if the evaluator is closed meanwhile.
     *
     * @param execution how the evaluator works, for the record
     * @param evaluator carries out the evaluations; closed if a run fails
     * @param atOnce    runs under way at the same time, at least 1
     */
    public void run(ExecutionSettings execution, Evaluator evaluator, int atOnce, Watcher watcher)
            throws InterruptedException {
        Queue<PlannedRun> waiting = new ConcurrentLinkedQueue<>(
                runs.stream().filter(run -> !run.isFinished()).toList());
        ExecutorService threads = Executors.newFixedThreadPool(atOnce);
        try {
            List<Future<?>> lanes = new ArrayList<>();
            for (int i = 0; i < atOnce; i++) {
                lanes.add(threads.submit(() -> carryOut(waiting, execution, evaluator, watcher)));
            }
            for (Future<?> lane : lanes) {
                lane.get();
            }
        } catch (ExecutionException e) {
            if (e.getCause() instanceof RuntimeException cause) {
                throw cause;
            }
            throw new IllegalStateException(e.getCause());
        } finally {
            threads.shutdown();
            threads.awaitTermination(1, TimeUnit.MINUTES);
        }
    }

    /** One after another as long as any wait, or until the evaluator is closed. */
    private static void carryOut(Queue<PlannedRun> waiting, ExecutionSettings execution, Evaluator evaluator,
            Watcher watcher) {
        try {
            for (PlannedRun run = waiting.poll(); run != null; run = waiting.poll()) {
                carryOut(run, execution, evaluator, watcher);
            }
        } catch (EvolutionStoppedException | InterruptedException e) {
            return;
        } catch (RuntimeException | Error e) {
            evaluator.close();
            throw e;
        }
    }

    private static void carryOut(PlannedRun run, ExecutionSettings execution, Evaluator evaluator, Watcher watcher)
            throws InterruptedException {
        try (RunWriter folder = run.open()) {
            long before = folder.recorded().end();
            EvolutionListener counter = new EvolutionListener() {
                @Override
                public void evaluated(EvaluationRecord evaluation) {
                    if (evaluation.result().id() >= before) {
                        watcher.evaluated();
                    }
                }
            };
            watcher.finished(folder, new EvolutionRun(folder).run(execution, evaluator, counter, watcher.forRun()));
        }
    }
}
