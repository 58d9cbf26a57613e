package io.natator.cli;

import io.natator.base.InvalidInputException;
import io.natator.checkpoint.RunReader;
import io.natator.checkpoint.RunWriter;
import io.natator.cli.Section.Topic;
import io.natator.config.Backend;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.Limits;
import io.natator.config.Preset;
import io.natator.config.SimulatorMode;
import io.natator.file.OutputFolder;
import io.natator.process.SceneInfo;
import io.natator.protocol.RequestRejectedException;
import io.natator.run.EvolutionRun;
import java.io.IOException;
import java.io.PrintWriter;
import java.io.StringWriter;
import java.nio.file.FileAlreadyExistsException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.concurrent.Callable;
import picocli.CommandLine.Command;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

/** {@code natator evolve}: evolves a creature. */
@Command(name = "evolve", mixinStandardHelpOptions = true,
        description = {"Evolves the gait of a creature, its body, or both.",
                "Prints the best; keeps everything in a run folder."},
        footer = {"", "Examples:",
                "  natator evolve --creature 2 --generations 6",
                "  natator evolve --scene fish.json --fitness net --output-dir runs/fish",
                "  natator evolve --optimizer nsga2 --objectives distance,work",
                "  natator evolve --creature eel --evolve both",
                "  natator evolve --creature 1 --seeds 10 --output-dir runs/ten",
                "  natator evolve --preset thesis --dry-run"})
final class EvolveCommand implements Callable<Integer> {

    private static final int AT_ONCE = 2;
    private static final int AT_ONCE_SHARED = 32;

    @Spec
    private CommandSpec spec;

    @Mixin
    private SceneOptions sceneOptions;

    @Mixin
    private CachedExecutionOptions executionOptions;

    @Mixin
    private SceneChoice choice;

    @Mixin
    private SearchOptions searchOptions;

    @Section(Topic.OUTPUT)
    @Option(names = "--output-dir", paramLabel = "DIR",
            description = "Run folder, new or empty. Default: runs/creature-N-seed-S, numbered if there is one.")
    private Path outputDir;

    @Section(Topic.OTHER)
    @Option(names = "--dry-run", description = "Say what would be done and how long it would take; do nothing.")
    private boolean dryRun;

    @Section(Topic.EXTENT)
    @Option(names = "--seeds", paramLabel = "N",
            description = "Evolve with so many seeds, from --seed on, several at once, each in the folder "
                    + "DIR/seed-S. The same command continues.")
    private Integer seeds;

    @Section(Topic.COMPUTING)
    @Option(names = "--runs-at-once", paramLabel = "N",
            description = "With --seeds: runs under way at the same time; their "
                    + "generations share a batch. Default: " + AT_ONCE_SHARED
                    + " with --simulator batch or spark, else " + AT_ONCE + ".")
    private Integer runsAtOnce;

    @Section(Topic.EXTENT)
    @Option(names = "--stop-after", paramLabel = "SECONDS", description = "Stop then, to be continued.")
    private Double stopAfter;

    @Override
    public Integer call() throws InterruptedException {
        if (stopAfter != null) {
            Limits.checkSeconds("--stop-after", stopAfter);
        }
        ExecutionSettings execution = executionOptions.execution(Backend.CPU);
        EvolutionSettings settings = settings(execution);
        if (seeds != null) {
            return evolveAll(settings, execution);
        }
        RunPreview preview = new RunPreview(settings, execution);
        if (dryRun) {
            Path folder = outputDir != null ? outputDir : freeFolder(settings.problem().scene());
            RunWriter.check(folder);
            StringWriter whole = new StringWriter();  // of what is refused meanwhile nothing is printed
            preview.print(folder, new PrintWriter(whole));
            spec.commandLine().getOut().print(whole);
            spec.commandLine().getOut().flush();
            return ExitCode.OK;
        }
        Path directory = outputDir != null ? outputDir : reserveFolder(settings.problem().scene());
        RunWriter folder = RunWriter.create(directory, settings);
        try (folder) {
            RunLauncher launcher = RunLauncher.of(spec.commandLine(), settings);
            preview.printAnyway(directory, launcher.out());
            launcher.run(folder, execution, stopAfter);
        } catch (InvalidInputException | RequestRejectedException e) {
            // What is refused with the first evaluation leaves no folder that would be in the way of the corrected command.
            RunWriter.deleteUnlessBegun(directory);
            throw e;
        }
        return ExitCode.OK;
    }

    /** With all seeds, as far as they are not finished. */
    private int evolveAll(EvolutionSettings settings, ExecutionSettings execution) throws InterruptedException {
        Limits.checkCount("--seeds", seeds, Limits.REPETITIONS);
        if (settings.search().seed() > Long.MAX_VALUE - seeds) {
            throw new InvalidInputException("--seed is " + settings.search().seed() + "; with --seeds " + seeds
                    + " expected at most " + (Long.MAX_VALUE - seeds));
        }
        if (outputDir == null || dryRun) {
            throw new InvalidInputException(dryRun ? "--seeds goes without --dry-run; leave one of them out"
                    : "--seeds goes with --output-dir; give both");
        }
        if (settings.search().optimizer().isOutside()) {
            throw new InvalidInputException(
                    "--seeds goes without --optimizer external, which speaks of one run; leave one of them out");
        }
        if (RunReader.exists(outputDir)) {
            throw new InvalidInputException(
                    "output folder " + outputDir + " is the folder of a run; choose another by --output-dir");
        }
        int atOnce = runsAtOnce != null ? runsAtOnce
                : execution.mode() == SimulatorMode.BATCH || execution.mode() == SimulatorMode.SPARK ? AT_ONCE_SHARED
                        : AT_ONCE;
        Limits.checkCount("--runs-at-once", atOnce, Limits.AT_ONCE);
        SeedRuns runs = new SeedRuns(settings, seeds, outputDir, spec.commandLine().getErr());
        runs.run(EvolutionRun.withTimeLimit(execution, settings), atOnce, stopAfter);
        spec.commandLine().getOut().println(runs.finished() + " of " + seeds + " runs finished in " + outputDir
                + (runs.finished() == seeds ? "" : "; the same command continues"));
        return ExitCode.OK;
    }

    private EvolutionSettings settings(ExecutionSettings execution) throws InterruptedException {
        Preset preset = searchOptions.preset();
        String sceneName = choice.scene(spec, preset);
        choice.checkCreature(preset, execution.simulator());
        EncodingKind encoding = searchOptions.encoding(sceneName);
        int actuators = SceneInfo.toEvolve(sceneName, encoding, sceneOptions.overrides(), execution.simulator())
                .actuators();
        EvolutionSettings swim = EvolutionSettings.of(sceneName, encoding, actuators).withBackend(execution.backend())
                .withScene(sceneOptions.scheme(),
                        sceneOptions.duration() != null ? sceneOptions.duration() : preset.duration(sceneName),
                        sceneOptions.overrides());
        return searchOptions.in(swim, sceneOptions.overrides(), execution.simulator());
    }

    /** A new folder that is this command's, though others that begin now look for one too. */
    private Path reserveFolder(String sceneName) {
        while (true) {
            Path folder = freeFolder(sceneName);
            try {
                OutputFolder.make(folder.toAbsolutePath().getParent());
                return Files.createDirectory(folder);
            } catch (FileAlreadyExistsException e) {
                if (!Files.isDirectory(folder)) {
                    throw OutputFolder.cannotBeMade(folder, e);
                }
            } catch (IOException e) {
                throw OutputFolder.cannotBeMade(folder, e);
            }
        }
    }

    /** runs/creature-1-seed-7, or with -2, -3 … if that is taken. */
    private Path freeFolder(String sceneName) {
        String name = SceneOptions.shortName(sceneName) + "-seed-" + searchOptions.seed();
        Path folder = Path.of("runs", name);
        for (int number = 2; Files.exists(folder); number++) {
            folder = Path.of("runs", name + "-" + number);
        }
        return folder;
    }
}
