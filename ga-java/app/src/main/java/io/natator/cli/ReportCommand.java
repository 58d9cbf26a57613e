package io.natator.cli;

import io.natator.checkpoint.StoredRun;
import io.natator.cli.Section.Topic;
import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import io.natator.config.FileErrors;
import io.natator.plot.Drawing;
import io.natator.report.GaitReport;
import io.natator.run.EvolutionRun;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Path;
import java.util.concurrent.Callable;
import picocli.CommandLine.Command;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

/** {@code natator report}: the thesis' pictures and numbers for any run. */
@Command(name = "report", mixinStandardHelpOptions = true,
        description = {"Runs a run's best gait once more, draws how it swims and says what fish it is like.",
            "Writes README.md, report.html and the pictures."})
final class ReportCommand implements Callable<Integer> {

    @Spec
    private CommandSpec spec;

    @Mixin
    private ExecutionOptions executionOptions;

    @Parameters(paramLabel = "RUN", description = "A run folder of evolve.")
    private Path directory;

    @Section(Topic.OUTPUT)
    @Option(names = "--output-dir", paramLabel = "DIR", description = "Default: RUN/report.")
    private Path outputDir;

    @Override
    public Integer call() throws InterruptedException {
        StoredRun run = StoredRun.in(directory);
        Path folder = outputDir != null ? outputDir : run.directory().resolve("report");
        GaitReport report = new GaitReport(run, folder);
        OneLineErrors.warn(spec.commandLine(), run.damage());
        ExecutionSettings execution = EvolutionRun.withTimeLimit(executionOptions.execution(Backend.CPU), run.settings());
        try {
            Drawing.checked(() -> spec.commandLine().getOut().println(report.write(execution)));
            if (report.difference() != null) {
                spec.commandLine().getErr().println(report.difference());
            }
        } catch (IOException e) {
            throw new UncheckedIOException("cannot write the report to " + folder + ": "
                    + FileErrors.whyNotMade(folder, e), e);
        }
        return ExitCode.OK;
    }
}
