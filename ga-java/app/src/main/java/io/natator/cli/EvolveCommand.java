package io.natator.cli;

import io.natator.base.InvalidInputException;
import io.natator.checkpoint.RunFolder;
import io.natator.checkpoint.StoredRun;
import io.natator.cli.Section.Topic;
import io.natator.config.Backend;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.ExecutionSettings;
import io.natator.config.Limits;
import io.natator.config.Preset;
import io.natator.file.OutputFolder;
import io.natator.process.SceneInfo;
import io.natator.protocol.RefusedSceneException;
import io.natator.protocol.RequestRejectedException;
import io.natator.run.EvolutionRun;
import io.natator.run.PlannedRun;
import io.natator.run.RunQueue;
import java.io.IOException;
import java.nio.file.FileAlreadyExistsException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.Callable;
import java.util.stream.LongStream;
import picocli.CommandLine.Command;
import picocli.CommandLine.ExitCode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Model.OptionSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

/** {@code natator evolve}: evolves a creature, or continues an interrupted run. */
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

    /** Options that do not change what a run computes, so that they may be given when it is continued. */
    private static final List<String> WITH_RESUME =
            List.of("--resume", "--stop-after", "--simulator", "--backend", "--device", "--workers", "--timeout",
                    "--simulator-path", "--simulator-command", "--master", "--no-cache");

    @Spec
    private CommandSpec spec;

    @Mixin
    private SceneOptions sceneOptions;

    @Mixin
    private ExecutionOptions executionOptions;

    @Mixin
    private CacheOptions cacheOptions;

    @Mixin
    private SceneChoice choice;

    @Mixin
    private SizeOptions sizeOptions;

    @Mixin
    private SearchOptions searchOptions;

    @Mixin
    private BodyOptions bodyOptions;

    @Section(Topic.OUTPUT)
    @Option(names = "--output-dir", paramLabel = "DIR",
            description = "Run folder, new or empty. Default: runs/creature-N-seed-S, numbered if there is one.")
    private Path outputDir;

    @Section(Topic.OTHER)
    @Option(names = "--dry-run", description = "Say what would be done and how long it would take; do nothing.")
    private boolean dryRun;

    @Section(Topic.EXTENT)
    @Option(names = "--seeds", paramLabel = "N", description = "Evolve with so many seeds, from --seed on, several at once, each in the folder "
            + "DIR/seed-S. The same command continues.")
    private Integer seeds;

    @Mixin
    private QueueOptions queueOptions;

    @Section(Topic.OTHER)
    @Option(names = "--resume", paramLabel = "DIR", description = "Continue the run in this folder.")
    private Path resume;

    @Override
    public Integer call() throws InterruptedException {
        Double stopAfter = queueOptions.stopAfter();
        if (resume != null) {
            refuseSettings();
            ResumeCommand.resume(resume, executionOptions, cacheOptions, stopAfter, null, spec);
            return ExitCode.OK;
        }
        ExecutionSettings execution = cacheOptions.in(executionOptions.execution(Backend.CPU));
        EvolutionSettings settings = settings(execution);
        if (seeds != null) {
            return evolveAll(settings, execution);
        }
        RunPreview preview = new RunPreview(settings, execution);
        if (dryRun) {
            Path folder = outputDir != null ? outputDir : freeFolder(settings.problem().scene());
            WholeOutput.print(spec.commandLine(), out -> preview.print(folder, out));
            return ExitCode.OK;
        }
        Path directory = outputDir != null ? outputDir : reserveFolder(settings.problem().scene());
        RunFolder folder = RunFolder.create(directory, settings);
        try (folder) {
            preview.printAnyway(directory, spec.commandLine().getOut());
            new RunLauncher(spec.commandLine().getOut(), spec.commandLine().getErr()).run(folder, execution, stopAfter);
        } catch (InvalidInputException | RequestRejectedException e) {
            // What is refused with the first evaluation leaves no folder that would be in the way of the corrected command.
            RunFolder.deleteUnlessBegun(directory);
            throw e;
        }
        return ExitCode.OK;
    }

    /** With all seeds, as far as they are not finished; their generations share a batch. */
    private int evolveAll(EvolutionSettings settings, ExecutionSettings execution) throws InterruptedException {
        Limits.checkCount("--seeds", seeds, Limits.REPETITIONS);
        if (outputDir == null || dryRun) {
            throw new InvalidInputException(dryRun ? "--seeds goes without --dry-run; leave one of them out" : "--seeds goes with --output-dir; give both");
        }
        if (StoredRun.exists(outputDir)) {
            throw new InvalidInputException("output folder " + outputDir + " is the folder of a run; choose another by --output-dir");
        }
        List<PlannedRun> runs = LongStream.range(settings.search().seed(), settings.search().seed() + seeds)
                .mapToObj(seed -> new PlannedRun(settings.withSeed(seed), outputDir.resolve("seed-" + seed))).toList();
        runs.forEach(PlannedRun::check);
        long finished = runs.stream().filter(PlannedRun::isFinished).count();
        boolean all = queueOptions.carryOut(new RunQueue(runs, execution.simulator())::run, EvolutionRun.withTimeLimit(execution, settings),
                runs.size(), (int) finished, seeds * ProgressEstimate.evaluations(settings), runs.stream().mapToLong(PlannedRun::recorded).sum(),
                spec.commandLine().getErr());
        spec.commandLine().getOut().println((all ? runs.size() : runs.stream().filter(PlannedRun::isFinished).count()) + " of " + runs.size()
                + " runs finished in " + outputDir + (all ? "" : "; the same command continues"));
        return ExitCode.OK;
    }

    static void checkStopAfter(Double seconds) {
        if (seconds != null) {
            Limits.checkSeconds("--stop-after", seconds);
        }
    }

    private void refuseSettings() {
        for (OptionSpec option : spec.commandLine().getParseResult().matchedOptions()) {
            if (!WITH_RESUME.contains(option.longestName())) {
                throw new ParameterException(spec.commandLine(), option.longestName()
                        + " cannot be given with --resume: the run keeps its settings");
            }
        }
    }

    private EvolutionSettings settings(ExecutionSettings execution) throws InterruptedException {
        Preset preset = sizeOptions.preset();
        String sceneName = choice.scene(spec, preset);
        EncodingKind encoding = searchOptions.encoding(sceneName);
        int actuators = actuators(sceneName, encoding, execution.simulator());
        EvolutionSettings settings = sizeOptions.in(EvolutionSettings.of(sceneName, encoding, actuators))
                .withBackend(execution.backend());
        return searchOptions.in(settings)
                .withScene(sceneOptions.scheme(),
                        sceneOptions.duration() != null ? sceneOptions.duration() : preset.duration(),
                        sceneOptions.overrides())
                .withEvolve(bodyOptions.evolution(sceneName, sceneOptions.overrides(), execution.simulator()));
    }

    private int actuators(String sceneName, EncodingKind kind, Path simulator) throws InterruptedException {
        try {
            return SceneInfo.toEvolve(sceneName, kind, sceneOptions.overrides(), simulator).actuators();
        } catch (RefusedSceneException e) {
            throw choice.refused(sceneName, e, simulator);
        }
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
