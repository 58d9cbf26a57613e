package io.natator.cli;

import io.natator.config.FileErrors;
import io.natator.plot.Drawing;
import io.natator.plot.PrecisionPlot;
import io.natator.plot.RooflinePlot;
import io.natator.plot.ValidationPlot;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.Callable;
import picocli.CommandLine.Command;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

/** {@code natator plot}: pictures of what {@code natator-sim bench} measured. */
@Command(name = "plot", mixinStandardHelpOptions = true,
        description = "Draws the results of natator-sim bench as PNG files.")
final class PlotCommand implements Callable<Integer> {

    @Spec
    private CommandSpec spec;

    @FunctionalInterface
    private interface Study {
        List<Path> draw(Path csv, Path folder) throws IOException;
    }

    /** What is drawn, and where to. */
    private static final class Files {

        @Parameters(paramLabel = "CSV", description = "Results of natator-sim bench of the same name.")
        private Path csv;

        @Option(names = "--output-dir", required = true, paramLabel = "DIR", description = "Where the pictures go.")
        private Path directory;
    }

    /** Without a command: what there is. */
    @Override
    public Integer call() {
        return SectionedHelp.missingCommand(spec);
    }

    @Command(name = "precision", mixinStandardHelpOptions = true,
            description = "Run time against path error, one picture per scene, with Pareto fronts.")
    int precision(@Mixin Files files) {
        return draw(PrecisionPlot::draw, files);
    }

    @Command(name = "roofline", mixinStandardHelpOptions = true,
            description = "How near the solver's stages come to what the processor can do.")
    int roofline(@Mixin Files files) {
        return draw(RooflinePlot::draw, files);
    }

    @Command(name = "validation", mixinStandardHelpOptions = true,
            description = "Front of the collapsing column against the experiment; density error beside other programs.")
    int validation(@Mixin Files files) {
        return draw(ValidationPlot::draw, files);
    }

    private int draw(Study study, Files files) {
        try {
            Drawing.checked(() -> study.draw(files.csv, files.directory).forEach(spec.commandLine().getOut()::println));
        } catch (IOException e) {
            throw new UncheckedIOException(files.directory + ": cannot be written: "
                    + FileErrors.reason(files.directory, e), e);
        }
        return ExitCode.OK;
    }
}
