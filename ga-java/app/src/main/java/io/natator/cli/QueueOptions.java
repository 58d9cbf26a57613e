package io.natator.cli;

import io.natator.cli.Section.Topic;
import io.natator.config.ExecutionSettings;
import io.natator.config.Limits;
import io.natator.config.SimulatorMode;
import io.natator.evolution.EvolutionListener;
import io.natator.process.Evaluator;
import io.natator.run.EvolutionRun;
import io.natator.run.RunQueue;
import java.io.PrintWriter;
import picocli.CommandLine.Option;

/** Options of commands that may carry out many runs, and how they carry them out. */
final class QueueOptions {

    private static final int AT_ONCE = 2;
    private static final int AT_ONCE_SHARED = 32;

    @Section(Topic.COMPUTING)
    @Option(names = "--runs-at-once", paramLabel = "N", description = "Runs under way at the same time; their "
            + "generations share a batch. Default: " + AT_ONCE_SHARED + " with --simulator batch or spark, else "
            + AT_ONCE + ".")
    private Integer runsAtOnce;

    @Section(Topic.EXTENT)
    @Option(names = "--stop-after", paramLabel = "SECONDS", description = "Stop then, to be continued.")
    private Double stopAfter;

    /** Seconds, or null. */
    Double stopAfter() {
        EvolveCommand.checkStopAfter(stopAfter);
        return stopAfter;
    }

    /** Runs under way at the same time. */
    int atOnce(ExecutionSettings execution) {
        int atOnce = runsAtOnce != null ? runsAtOnce
                : execution.mode() == SimulatorMode.BATCH || execution.mode() == SimulatorMode.SPARK ? AT_ONCE_SHARED : AT_ONCE;
        Limits.checkCount("--runs-at-once", atOnce, Limits.AT_ONCE);
        return atOnce;
    }

    /** Runs to carry out, of which some may be finished. */
    @FunctionalInterface
    interface Work {
        boolean run(ExecutionSettings execution, Evaluator evaluator, int atOnce, RunQueue.Watcher watcher)
                throws InterruptedException;
    }

    /**
     * Carries the work out until it is done or the time is up.
     *
     * @param runs        how many runs there are
     * @param finished    how many of them are finished
     * @param evaluations how many they take together, as far as is known
     * @param recorded    how many of these are recorded already
     * @return whether all runs are finished
     */
    boolean carryOut(Work work, ExecutionSettings execution, int runs, int finished, long evaluations, long recorded,
            PrintWriter err) throws InterruptedException {
        int atOnce = atOnce(execution);
        try (Evaluator evaluator = EvolutionRun.open(execution);
                ShutdownHandler shutdown = new ShutdownHandler(evaluator, stopAfter, () -> sayGoodbye(err))) {
            StudyProgress progress = new StudyProgress(runs, finished, evaluations, recorded, err) {
                @Override
                public EvolutionListener forRun() {
                    return execution.inBatches() ? shutdown.beforeLateGenerations()
                            : new EvolutionListener() { };
                }
            };
            return work.run(execution, evaluator, atOnce, progress);
        }
    }

    static void sayGoodbye(PrintWriter err) {
        err.println("interrupted; the same command continues");
        err.flush();
    }
}
