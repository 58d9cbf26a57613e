package io.natator.cli;

import io.natator.base.Numbers;
import io.natator.checkpoint.CompactRun;
import io.natator.checkpoint.RunFolder;
import io.natator.checkpoint.SceneDigest;
import io.natator.checkpoint.StoredRun;
import io.natator.cli.Section.Topic;
import io.natator.config.Backend;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
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
    private ExecutionOptions executionOptions;

    @Mixin
    private CacheOptions cacheOptions;

    @Section(Topic.EXTENT)
    @Option(names = "--generations", paramLabel = "N",
            description = "Go on to so many generations after the random one, also where the run is finished; at least those that are done.")
    private Integer generations;

    @Section(Topic.EXTENT)
    @Option(names = "--stop-after", paramLabel = "SECONDS", description = "Stop then, to be continued.")
    private Double stopAfter;

    @Section(Topic.OUTPUT)
    @Option(names = "--compact", description = "Drop the single evaluations of the finished run, some ten megabytes, which the same seed gives "
            + "again; it can still go on to more generations.")
    private boolean compact;

    @Parameters(paramLabel = "RUN", description = "Run folder.")
    private Path folder;

    @Override
    public Integer call() throws InterruptedException {
        resume(folder, executionOptions, cacheOptions, stopAfter, generations, spec);
        if (compact && StoredRun.isFinished(folder) && !CompactRun.isCompact(folder)) {
            CompactRun.compact(folder);
        }
        return ExitCode.OK;
    }

    /**
     * Continues a run.
     *
     * @param stopAfter   seconds, or null
     * @param generations that it is to have from here on, or null
     */
    static void resume(Path directory, ExecutionOptions options, CacheOptions cache, Double stopAfter, Integer generations,
            CommandSpec spec) throws InterruptedException {
        EvolveCommand.checkStopAfter(stopAfter);
        EvolutionSettings settings = StoredRun.settings(directory);
        Backend before = settings.budget().backend();
        // Asks the simulator, so that where there is none nothing is changed.
        ExecutionSettings execution = EvolutionRun.withTimeLimit(cache.in(options.execution(before)), settings);
        SceneDigest.check(directory, settings, SceneDigest.of(settings, execution.simulator()));
        RunFolder folder = RunFolder.open(directory);
        if (generations != null) {
            changeGenerations(folder, generations);
        }
        boolean isFinished = StoredRun.isFinished(directory);
        if (isChanged(before, isFinished, options)) {
            folder.changeBackend(options.backend());
        }
        tell(before, isFinished, options, spec);
        new RunLauncher(spec.commandLine().getOut(), spec.commandLine().getErr()).run(folder, execution, stopAfter);
    }

    private static void changeGenerations(RunFolder folder, int generations) {
        EvolutionState state = folder.checkpoint();
        int done = state == null ? 0 : state.generation();
        folder.refuse(generations < done ? "--generations is " + generations + "; expected at least the " + done + " that are done"
                : state != null && generations > done && state.isLastOf(folder.settings().withGenerations(generations))
                ? folder.directory() + " ends after its " + Numbers.count(state.evaluations(), "evaluation")
                        + ", however many --generations it may have" : null);
        if (generations != folder.settings().budget().generations()) {
            folder.changeGenerations(generations);
        }
    }

    /** Whether the run goes on on another backend; what is finished keeps the one that it was computed on. */
    private static boolean isChanged(Backend before, boolean isFinished, ExecutionOptions options) {
        return isOther(before, options) && !isFinished;
    }

    private static boolean isOther(Backend before, ExecutionOptions options) {
        return options.backend() != null && options.backend() != before;
    }

    /** Tells of another backend that is asked for. */
    private static void tell(Backend before, boolean isFinished, ExecutionOptions options, CommandSpec spec) {
        if (isOther(before, options)) {
            spec.commandLine().getErr().println(isFinished
                    ? "finished on backend " + before.argument() + "; nothing is left to compute on " + options.backend().argument()
                    : "backend was " + before.argument() + ", is now " + options.backend().argument()
                            + ": last digits, and with them gaits, will differ from those of a run that kept it");
        }
    }
}
