package io.natator.cli;

import io.natator.checkpoint.Archipelago;
import io.natator.checkpoint.RunFolder;
import io.natator.checkpoint.StoredRun;
import io.natator.cli.Section.Topic;
import io.natator.config.Backend;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.InvalidInputException;
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
            description = "Go on to so many generations after the random one, more than the run was begun with; one that is finished, too.")
    private Integer generations;

    @Section(Topic.EXTENT)
    @Option(names = "--stop-after", paramLabel = "SECONDS", description = "Stop then, to be continued.")
    private Double stopAfter;

    @Parameters(paramLabel = "RUN", description = "Run folder.")
    private Path folder;

    @Override
    public Integer call() throws InterruptedException {
        if (generations != null) {
            extend(folder, generations);
        }
        resume(folder, executionOptions, cacheOptions, stopAfter, spec);
        return ExitCode.OK;
    }

    private static void extend(Path directory, int generations) {
        boolean islands = Archipelago.exists(directory);
        EvolutionSettings settings = islands ? Archipelago.in(directory).plan().settings() : StoredRun.settings(directory);
        if (generations < settings.generations()) {
            throw new InvalidInputException("--generations is " + generations + "; expected at least the " + settings.generations()
                    + " of " + directory);
        }
        if (generations == settings.generations()) {
            return;
        }
        if (islands) {
            Archipelago.in(directory).extend(generations);
            return;
        }
        EvolutionRun.checkAlone(directory, settings);
        try (RunFolder folder = RunFolder.open(directory)) {
            folder.extend(generations);
        }
    }

    static void resume(Path directory, ExecutionOptions options, CacheOptions cache, Double stopAfter,
            CommandSpec spec) throws InterruptedException {
        EvolveCommand.checkStopAfter(stopAfter);
        if (Archipelago.exists(directory)) {
            resume(Archipelago.in(directory), options, cache, stopAfter, spec);
            return;
        }
        EvolutionSettings settings = StoredRun.settings(directory);
        EvolutionRun.checkAlone(directory, settings);
        Backend before = settings.backend();
        ExecutionSettings execution = cache.in(options.execution(before));
        RunFolder folder = RunFolder.open(directory);
        if (isChanged(before, StoredRun.isFinished(directory), options, spec)) {
            folder.changeBackend(options.backend());
        }
        new RunLauncher(spec.commandLine().getOut(), spec.commandLine().getErr()).run(folder, execution, stopAfter);
    }

    private static void resume(Archipelago stored, ExecutionOptions options, CacheOptions cache, Double stopAfter,
            CommandSpec spec) throws InterruptedException {
        Backend before = stored.plan().settings().backend();
        ExecutionSettings execution = cache.in(options.execution(before));
        boolean isFinished = stored.plan().islands() == stored.folders().stream().filter(StoredRun::isFinished).count();
        Archipelago archipelago = isChanged(before, isFinished, options, spec) ? stored.changeBackend(options.backend()) : stored;
        new IslandsLauncher(spec.commandLine().getOut(), spec.commandLine().getErr()).run(archipelago, execution, stopAfter);
    }

    /** Whether another backend is asked for, which is told of; what is finished keeps the one that it was computed on. */
    private static boolean isChanged(Backend before, boolean isFinished, ExecutionOptions options, CommandSpec spec) {
        boolean isOther = options.backend() != null && options.backend() != before;
        boolean changed = isOther && !isFinished;
        if (isOther && isFinished) {
            spec.commandLine().getErr().println("finished on backend " + before.argument() + "; nothing is left to compute on "
                    + options.backend().argument());
        }
        if (changed) {
            spec.commandLine().getErr().println("backend was " + before.argument() + ", is now " + options.backend().argument()
                    + ": last digits, and with them gaits, will differ from those of a run that kept it");
        }
        return changed;
    }
}
