package io.natator.run;

import io.natator.checkpoint.RunFolder;
import io.natator.config.ExecutionSettings;
import io.natator.evolution.EvaluationRecord;
import io.natator.evolution.EvolutionListener;
import io.natator.process.Evaluator;
import java.nio.file.Path;
import java.util.List;

/** Carries out many runs, several at the same time with one evaluator, so that their generations share a batch. */
public final class RunQueue {

    private final List<PlannedRun> runs;

    /**
     * A queue in which the runs are begun in this order. Writes nothing.
     *
     * @param simulator the native program, which knows the scenes
     * @throws io.natator.base.InvalidInputException if a scene was changed since a run in it was begun that is to go on
     * @throws InterruptedException                    if the calling thread is interrupted
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
        void finished(RunFolder run, EvolutionRun.Outcome outcome);

        /** Something to tell, in one line. */
        default void said(String line) {
        }

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
        return Lanes.carryOut(runs.stream().filter(run -> !run.isFinished())
                .<Lanes.Work>map(run -> () -> carryOut(run, execution, evaluator, watcher)).toList(), evaluator, atOnce);
    }

    private static void carryOut(PlannedRun run, ExecutionSettings execution, Evaluator evaluator, Watcher watcher)
            throws InterruptedException {
        try (RunFolder folder = run.open()) {
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
