package io.natator.cli;

import io.natator.cli.Section.Topic;
import io.natator.config.Backend;
import io.natator.config.ExecutionSettings;
import io.natator.study.FlexStudy;
import java.nio.file.Path;
import java.time.Duration;
import java.util.concurrent.Callable;
import picocli.CommandLine.Command;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

/** {@code natator compare-flex}: sets our swimming speeds beside those measured with NVIDIA Flex. */
@Command(name = "compare-flex", mixinStandardHelpOptions = true,
        description = {"Runs scenes and variants that NVIDIA Flex 1.2.0 was measured in, and compares the speeds.",
            "Continues where an interrupted study stopped; evaluations of another build or other settings are redone, "
                + "those of changed scene or creature files are not: remove evaluations.jsonl after changing these."},
        customSynopsis = "natator compare-flex --variants FILE --output-dir DIR [OPTIONS]")
final class CompareFlexCommand implements Callable<Integer> {

    private static final Duration TIMEOUT = Duration.ofMinutes(5);

    @Spec
    private CommandSpec spec;

    @Mixin
    private ExecutionOptions executionOptions;

    @Section(Topic.SCENE)
    @Option(names = "--variants", required = true, paramLabel = "FILE", description = "List of variants as JSON.")
    private Path variants;

    @Section(Topic.OUTPUT)
    @Option(names = "--output-dir", required = true, paramLabel = "DIR", description = "Where the results go.")
    private Path directory;

    @Section(Topic.EXTENT)
    @Option(names = "--runs", paramLabel = "N", defaultValue = "5",
            description = "Runs per variant and interval, from 1. Default: ${DEFAULT-VALUE}.")
    private int runs;

    @Section(Topic.SCENE)
    @Option(names = "--only", paramLabel = "NAME", description = "Evaluate one variant only.")
    private String only;

    @Override
    public Integer call() throws InterruptedException {
        ExecutionSettings execution = executionOptions.execution(Backend.CPU);
        if (execution.timeout() == null) {
            execution = execution.withTimeout(TIMEOUT);
        }
        Path page = new FlexStudy(variants, directory, runs).run(execution, only);
        spec.commandLine().getOut().println(page);
        return ExitCode.OK;
    }
}
