package io.natator.cli;

import io.natator.checkpoint.Archipelago;
import io.natator.checkpoint.StoredRun;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.evolution.EvolutionListener;
import io.natator.file.ShellWord;
import io.natator.run.EvolutionRun;
import io.natator.run.IslandsRun;
import io.natator.simulator.Evaluator;
import java.io.PrintWriter;

/** Runs the evolutions of an archipelago for the command line: progress, an early stop, the report. */
final class IslandsLauncher {

    private final PrintWriter out;
    private final PrintWriter err;

    IslandsLauncher(PrintWriter out, PrintWriter err) {
        this.out = out;
        this.err = err;
    }

    /**
     * Runs to the end, or as long as there is time.
     *
     * @param stopAfter seconds, or null
     */
    void run(Archipelago archipelago, ExecutionSettings execution, Double stopAfter) throws InterruptedException {
        Archipelago.Plan plan = archipelago.plan();
        ExecutionSettings limited = EvolutionRun.withTimeLimit(execution, plan.settings());
        long recorded = archipelago.folders().stream().mapToLong(folder -> StoredRun.recorded(folder).end()).sum();
        String how = "continue by: " + ProgramName.asCalled() + " resume " + ShellWord.of(archipelago.directory());
        boolean finished;
        try (Evaluator evaluator = EvolutionRun.open(limited);
                ShutdownHandler shutdown = new ShutdownHandler(evaluator, stopAfter, () -> say("interrupted; " + how))) {
            StudyProgress progress = new StudyProgress(plan.islands(), IslandsRun.finished(archipelago),
                    plan.islands() * expected(plan.settings()), recorded, err) {
                @Override
                public EvolutionListener forRun() {
                    return limited.inBatches() ? shutdown.beforeLateGenerations() : new EvolutionListener() { };
                }
            };
            finished = new IslandsRun(archipelago).run(limited, evaluator, progress);
            if (!finished && shutdown.isTimeUp()) {
                say("time is up; " + how);
            }
        }
        if (finished) {
            print(archipelago);
        }
    }

    private static long expected(EvolutionSettings settings) {
        ProgressEstimate estimate = new ProgressEstimate(settings, System::nanoTime);
        return estimate.expected();
    }

    private void print(Archipelago archipelago) {
        IslandsReport.print(archipelago, out);
        StoredRun winner = StoredRun.in(archipelago.folder(archipelago.winner()));
        new RunReport(out).print(winner.settings(), winner.state(), winner.best(), winner.directory());
        out.println("  run folder  " + archipelago.directory() + ", the winner's " + winner.directory());
        out.flush();
    }

    private void say(String line) {
        err.println(line);
        err.flush();
    }
}
