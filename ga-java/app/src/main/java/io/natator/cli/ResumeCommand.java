package io.natator.cli;

import io.natator.base.Numbers;
import io.natator.checkpoint.CompactRun;
import io.natator.checkpoint.RunReader;
import io.natator.checkpoint.RunWriter;
import io.natator.checkpoint.SceneDigest;
import io.natator.cli.Section.Topic;
import io.natator.config.Backend;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.Limits;
import io.natator.evolution.EvolutionState;
import io.natator.run.EvolutionRun;
import java.nio.file.Path;
import java.util.concurrent.Callable;
import picocli.CommandLine.Command;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

/** {@code natator resume}: continues a run. */
@Command(name = "resume", mixinStandardHelpOptions = true,
        description = {"Continues a run that was interrupted, or gives one more generations.",
                "Its outcome is that of an uninterrupted one, unless it continues on another backend."},
        footer = {"", "Examples:", "  natator resume runs/creature-1-seed-1",
                "  natator resume runs/creature-1-seed-1 --generations 200"})
final class ResumeCommand implements Callable<Integer> {

    @Spec
    private CommandSpec spec;

    @Mixin
    private CachedExecutionOptions executionOptions;

    @Section(Topic.EXTENT)
    @Option(names = "--generations", paramLabel = "N",
            description = "Go on to so many generations after the random one, also where the run is finished; at least those that are done.")
    private Integer generations;

    @Section(Topic.EXTENT)
    @Option(names = "--stop-after", paramLabel = "SECONDS", description = "Stop then, to be continued.")
    private Double stopAfter;

    @Section(Topic.OUTPUT)
    @Option(names = "--compact",
            description = "Drop the single evaluations of the finished run, some ten megabytes, which the same seed gives "
                    + "again; it can still go on to more generations.")
    private boolean compact;

    @Parameters(paramLabel = "RUN", description = "Run folder.")
    private Path directory;

    @Override
    public Integer call() throws InterruptedException {
        if (stopAfter != null) {
            Limits.checkSeconds("--stop-after", stopAfter);
        }
        EvolutionSettings settings = RunReader.settings(directory);
        Backend before = settings.budget().backend();
        // Asks the simulator, so that where there is none nothing is changed.
        ExecutionSettings execution = EvolutionRun.withTimeLimit(executionOptions.execution(before), settings);
        SceneDigest.check(directory, settings, SceneDigest.of(settings, execution.simulator()));
        RunWriter folder = RunWriter.open(directory);
        if (generations != null) {
            changeGenerations(folder, generations);
        }
        if (execution.backend() != before) {
            changeBackend(folder, before, execution.backend());
        }
        RunLauncher.of(spec.commandLine(), settings).run(folder, execution, stopAfter);
        if (compact && RunReader.isFinished(directory) && !CompactRun.isCompact(directory)) {
            CompactRun.compact(directory);
        }
        return ExitCode.OK;
    }

    private static void changeGenerations(RunWriter folder, int generations) {
        EvolutionState state = folder.checkpoint();
        int done = state == null ? 0 : state.generation();
        folder.refuse(generations < done
                ? "--generations is " + generations + "; expected at least the " + done + " that are done"
                : state != null && generations > done && state.isLastOf(folder.settings().withGenerations(generations))
                        ? folder.directory() + " ends after its " + Numbers.count(state.evaluations(), "evaluation")
                                + ", however many --generations it may have"
                        : null);
        if (generations != folder.settings().budget().generations()) {
            folder.changeGenerations(generations);
        }
    }

    /** What is finished keeps the backend that it was computed on. */
    private void changeBackend(RunWriter folder, Backend before, Backend after) {
        boolean isFinished = RunReader.isFinished(directory);
        if (!isFinished) {
            folder.changeBackend(after);
        }
        spec.commandLine().getErr().println(isFinished
                ? "finished on backend " + before.argument() + "; nothing is left to compute on " + after.argument()
                : "backend was " + before.argument() + ", is now " + after.argument()
                        + ": last digits, and with them gaits, will differ from those of a run that kept it");
    }
}
