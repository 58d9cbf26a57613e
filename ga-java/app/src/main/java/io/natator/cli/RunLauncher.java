package io.natator.cli;

import io.natator.checkpoint.RunWriter;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.evolution.EvolutionListener;
import io.natator.evolution.EvolutionStoppedException;
import io.natator.file.ShellWord;
import io.natator.process.Evaluator;
import io.natator.process.OptimizerPipe;
import io.natator.run.EvolutionRun;
import java.io.FileDescriptor;
import java.io.FileOutputStream;
import java.io.PrintWriter;
import picocli.CommandLine;

/**
 * Runs the evolution of a folder for the command line: progress, an early stop, the report.
 *
 * @param out what people read
 */
record RunLauncher(PrintWriter out, PrintWriter err) {

    /** For a command, whose standard output is the optimizer's if that is outside this program: then people read standard error. */
    static RunLauncher of(CommandLine command, EvolutionSettings settings) {
        return new RunLauncher(settings.search().optimizer().isOutside() ? command.getErr() : command.getOut(),
                command.getErr());
    }

    /**
     * Runs to the end, or as long as there is time.
     *
     * @param folder    closed afterwards
     * @param stopAfter seconds, or null
     */
    void run(RunWriter folder, ExecutionSettings execution, Double stopAfter) throws InterruptedException {
        String how = "continue by: " + Main.asCalled() + " resume " + ShellWord.of(folder.directory());
        try (folder) {
            ExecutionSettings limited = EvolutionRun.withTimeLimit(execution, folder.settings());
            boolean isOutside = folder.settings().search().optimizer().isOutside();
            try (OptimizerPipe pipe = isOutside ? new OptimizerPipe(System.in, new FileOutputStream(FileDescriptor.out))
                    : null;
                    Evaluator evaluator = EvolutionRun.open(limited);
                    ShutdownHandler shutdown = new ShutdownHandler(() -> stop(evaluator, pipe), stopAfter,
                            () -> say("interrupted; " + how))) {
                EvolutionRun.Outcome outcome;
                try (Progress progress = new Progress(folder.settings(), folder.checkpoint(), folder.recorded().end(),
                        err, System.console() != null ? System.err : null)) {
                    outcome = new EvolutionRun(folder, pipe).run(limited, evaluator, limited.inBatches()
                            ? new EvolutionListener[] {progress, shutdown.beforeLateGenerations()}
                            : new EvolutionListener[] {progress});
                } catch (EvolutionStoppedException | InterruptedException e) {
                    if (shutdown.isTimeUp()) {
                        say("time is up; " + how);
                    }
                    return;
                }
                new RunReport(out).print(folder.settings(), outcome.state(), outcome.best(), folder.directory());
                out.println("  run folder  " + folder.directory());
                out.flush();
            }
        }
    }

    private static void stop(Evaluator evaluator, OptimizerPipe pipe) {
        evaluator.close();
        if (pipe != null) {
            pipe.close();
        }
    }

    private void say(String line) {
        err.println(line);
        err.flush();
    }
}
