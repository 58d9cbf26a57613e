package io.natator.cli;

import io.natator.config.ExecutionSettings;
import io.natator.simulator.SimulatorLocator;
import io.natator.study.FlexStudy;
import java.nio.file.Path;
import java.time.Duration;
import java.util.concurrent.Callable;
import picocli.CommandLine.Command;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

/** {@code natator compare-flex}: sets our swimming speeds beside those measured with NVIDIA Flex. */
@Command(name = "compare-flex", mixinStandardHelpOptions = true,
        description = {"Runs scenes and variants that NVIDIA Flex 1.2.0 was measured in, and compares the speeds.",
            "Continues where an interrupted study stopped; evaluations of another build or other settings are redone, "
                + "those of changed scene or creature files are not: remove evaluations.jsonl after changing these."})
final class CompareFlexCommand implements Callable<Integer> {

    private static final Duration TIMEOUT = Duration.ofMinutes(5);

    @Spec
    private CommandSpec spec;

    @Option(names = "--variants", required = true, paramLabel = "FILE", description = "List of variants as JSON.")
    private Path variants;

    @Option(names = "--output-dir", required = true, paramLabel = "DIR", description = "Where the results go.")
    private Path directory;

    @Option(names = "--runs", paramLabel = "N", defaultValue = "5",
            description = "Runs per variant and interval, from 1. Default: ${DEFAULT-VALUE}.")
    private int runs;

    @Option(names = "--workers", paramLabel = "N", defaultValue = "1",
            description = "Evaluations at the same time, from 1. Default: ${DEFAULT-VALUE}.")
    private int workers;

    @Option(names = "--only", paramLabel = "NAME", description = "Evaluate one variant only.")
    private String only;

    @Option(names = "--simulator-path", paramLabel = "FILE", description = "The native program. Default: the one that "
            + "the environment variable " + SimulatorLocator.VARIABLE + " names, else build/release/bin/natator-sim.")
    private Path simulatorPath;

    @Override
    public Integer call() throws InterruptedException {
        // The results name the program as it is seen from here, not where on this machine it lies.
        Path simulator = Path.of("").toAbsolutePath().relativize(SimulatorLocator.locate(simulatorPath));
        ExecutionSettings execution = new ExecutionSettings(simulator, workers, TIMEOUT);
        Path page = new FlexStudy(variants, directory, runs).run(execution, only);
        spec.commandLine().getOut().println(page);
        return ExitCode.OK;
    }
}
