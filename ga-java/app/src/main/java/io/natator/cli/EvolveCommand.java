package io.natator.cli;

import io.natator.checkpoint.Archipelago;
import io.natator.checkpoint.RunFolder;
import io.natator.cli.Section.Topic;
import io.natator.config.Backend;
import io.natator.config.BodyEvolution;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.Evolved;
import io.natator.config.ExecutionSettings;
import io.natator.config.FitnessKind;
import io.natator.config.InvalidInputException;
import io.natator.config.Judge;
import io.natator.config.Limits;
import io.natator.config.OperatorSet;
import io.natator.config.OptimizerKind;
import io.natator.config.Preset;
import io.natator.config.WeightedObjective;
import io.natator.file.OutputFolder;
import io.natator.simulator.RefusedSceneException;
import io.natator.simulator.RequestRejectedException;
import io.natator.simulator.SceneInfo;
import java.io.IOException;
import java.nio.file.FileAlreadyExistsException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.Callable;
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
    private IslandOptions islandOptions;

    @Section(Topic.EXTENT)
    @Option(names = "--preset", paramLabel = "PRESET", defaultValue = "quick",
            description = "quick (population 16, 3 generations of 2 s in pool/creature-N, 1 start) or thesis (150, 100, "
                    + "as thesis/creature-N has it, 4 starts). Other options change parts of it. "
                    + "Default: ${DEFAULT-VALUE}.")
    private Preset preset;

    @Section(Topic.EXTENT)
    @Option(names = "--population", paramLabel = "N", description = "Chromosomes selected in each generation, from 2.")
    private Integer population;

    @Section(Topic.EXTENT)
    @Option(names = "--generations", paramLabel = "N", description = "Generations after the random one, from 0.")
    private Integer generations;

    @Section(Topic.EXTENT)
    @Option(names = "--evaluations", paramLabel = "N",
            description = "End after so many evaluations, from 1; of several starts, with the last whole gait. "
                    + "Default: what the generations take.")
    private Long evaluations;

    @Section(Topic.EXTENT)
    @Option(names = "--starts", paramLabel = "K", description = "Run every gait from so many starts, from 1, and the best "
            + "of each generation again from others; 1 is the scene's own start, once. Default: the preset's.")
    private Integer starts;

    @Section(Topic.SEARCH)
    @Option(names = "--judge", paramLabel = "HOW", defaultValue = "mean", description = "What the runs of a gait are worth: "
            + "mean, median (from 3 starts) or lower-quartile (from 4). Default: ${DEFAULT-VALUE}.")
    private Judge judge;

    @Section(Topic.SEARCH)
    @Option(names = "--optimizer", paramLabel = "NAME", defaultValue = "jgap",
            description = "jgap (the thesis' genetic algorithm), cma-es, random, map-elites (the best of every kind of gait), "
                    + "or for several objectives nsga2. Default: ${DEFAULT-VALUE}.")
    private OptimizerKind optimizer;

    @Section(Topic.SEARCH)
    @Option(names = "--seed", paramLabel = "N", defaultValue = "1",
            description = "The same seed gives the same run. Default: ${DEFAULT-VALUE}.")
    private long seed;

    @Section(Topic.SEARCH)
    @Option(names = "--operators", paramLabel = "SET", defaultValue = "corrected",
            description = "Genetic operators: corrected, or stock (as JGAP ships them). Default: ${DEFAULT-VALUE}.")
    private OperatorSet operators;

    @Section(Topic.SEARCH)
    @Option(names = "--gaussian-deviation", paramLabel = "X", defaultValue = "0.05",
            description = "Deviation of the Gaussian mutation as a share of a gene's range. Default: ${DEFAULT-VALUE}.")
    private double gaussianDeviation;

    @Section(Topic.SEARCH)
    @Option(names = "--fitness", paramLabel = "KIND", defaultValue = "distance", description = "What is rewarded: "
            + "distance, or net: less what the gait drifts forwards in vacuum. Default: ${DEFAULT-VALUE}.")
    private FitnessKind fitness;

    @Section(Topic.SEARCH)
    @Option(names = "--objectives", paramLabel = "NAME[=WEIGHT],...", description = "What is rewarded instead of --fitness: "
            + "distance, net, forward (by its own heading), straight, work, efficiency. One; several with weights, as a sum; "
            + "for nsga2 several without.")
    private String objectives;

    @Section(Topic.SEARCH)
    @Option(names = "--vacuum-check", description = "Run every generation's new best in vacuum too; see vacuum.jsonl.")
    private boolean vacuumCheck;

    @Section(Topic.SEARCH)
    @Option(names = "--encoding", paramLabel = "KIND",
            description = "Genes: dense or sparse, or either with an offset to steer by, dense-steered or sparse-steered. Default: the "
                    + "creature's (2 is sparse, the others dense); of goals/… sparse-steered.")
    private EncodingKind encoding;

    @Section(Topic.SEARCH)
    @Option(names = "--evolve", paramLabel = "WHAT", defaultValue = "gait", description = "gait, body or both: of a creature "
            + "that is given by a profile, its length, sections, joints, stiffness and muscle strength too, with the scene's volume "
            + "and strength in all. Default: ${DEFAULT-VALUE}.")
    private Evolved evolve;

    @Section(Topic.SEARCH)
    @Option(names = "--gait", paramLabel = "FILE", description = "With --evolve body: what all bodies swim with, a JSON file with a "
            + "gait or a run's best.json.")
    private Path gait;

    @Section(Topic.OUTPUT)
    @Option(names = "--output-dir", paramLabel = "DIR",
            description = "Run folder, new or empty. Default: runs/creature-N-seed-S, numbered if there is one.")
    private Path outputDir;

    @Section(Topic.OTHER)
    @Option(names = "--dry-run", description = "Say what would be done and how long it would take; do nothing.")
    private boolean dryRun;

    @Section(Topic.EXTENT)
    @Option(names = "--stop-after", paramLabel = "SECONDS", description = "Stop then, to be continued by --resume.")
    private Double stopAfter;

    @Section(Topic.OTHER)
    @Option(names = "--resume", paramLabel = "DIR", description = "Continue the run in this folder.")
    private Path resume;

    @Override
    public Integer call() throws InterruptedException {
        checkStopAfter(stopAfter);
        if (resume != null) {
            refuseSettings();
            ResumeCommand.resume(resume, executionOptions, cacheOptions, stopAfter, null, spec);
            return ExitCode.OK;
        }
        ExecutionSettings execution = cacheOptions.in(executionOptions.execution(Backend.CPU));
        EvolutionSettings settings = settings(execution);
        Archipelago.Plan islands = islandOptions.plan(settings);
        RunPreview preview = new RunPreview(settings, islands, execution);
        if (dryRun) {
            Path folder = outputDir != null ? outputDir : freeFolder(settings.scene());
            WholeOutput.print(spec.commandLine(), out -> preview.print(folder, out));
            return ExitCode.OK;
        }
        Path directory = outputDir != null ? outputDir : reserveFolder(settings.scene());
        if (islands != null) {
            beginIslands(Archipelago.create(directory, islands), preview, execution);
        } else {
            beginRun(RunFolder.create(directory, settings), preview, execution);
        }
        return ExitCode.OK;
    }

    /** Evolves; what is refused with the first evaluation leaves no folder that would be in the way of the corrected command. */
    private void beginRun(RunFolder folder, RunPreview preview, ExecutionSettings execution) throws InterruptedException {
        try (folder) {
            preview.printAnyway(folder.directory(), spec.commandLine().getOut());
            new RunLauncher(spec.commandLine().getOut(), spec.commandLine().getErr()).run(folder, execution, stopAfter);
        } catch (InvalidInputException | RequestRejectedException e) {
            RunFolder.deleteUnlessBegun(folder.directory());
            throw e;
        }
    }

    /** The same of islands. */
    private void beginIslands(Archipelago archipelago, RunPreview preview, ExecutionSettings execution) throws InterruptedException {
        try {
            preview.printAnyway(archipelago.directory(), spec.commandLine().getOut());
            new IslandsLauncher(spec.commandLine().getOut(), spec.commandLine().getErr()).run(archipelago, execution, stopAfter);
        } catch (InvalidInputException | RequestRejectedException e) {
            archipelago.deleteUnlessBegun();
            throw e;
        }
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
        String sceneName = choice.scene(spec, preset);
        EncodingKind kind = encoding != null ? encoding : EncodingKind.usualFor(sceneName);
        int actuators = actuators(sceneName, kind, execution.simulator());
        return EvolutionSettings.of(sceneName, kind, actuators)
                .withSize(population != null ? population : preset.population(), generations())
                .withEvaluations(evaluations).withSeed(seed)
                .withOptimizer(OptimizerKind.JGAP, operators, gaussianDeviation)
                .withFitness(fitness, vacuumCheck).withBackend(execution.backend())
                .withStarts(starts != null ? starts : preset.starts(), judge)
                .withObjectives(optimizer, objectives == null ? null : WeightedObjective.parse(objectives))
                .withScene(sceneOptions.scheme(),
                        sceneOptions.duration() != null ? sceneOptions.duration() : preset.duration(),
                        sceneOptions.overrides())
                .withEvolve(bodies(sceneName, execution.simulator()));
    }

    private int actuators(String sceneName, EncodingKind kind, Path simulator) throws InterruptedException {
        try {
            return SceneInfo.toEvolve(sceneName, kind, sceneOptions.overrides(), simulator).actuators();
        } catch (RefusedSceneException e) {
            throw choice.refused(sceneName, e, simulator);
        }
    }

    /** What to change of the body; null for nothing. */
    private BodyEvolution bodies(String sceneName, Path simulator) throws InterruptedException {
        if ((evolve == Evolved.BODY) != (gait != null)) {
            throw new InvalidInputException(gait == null ? "--evolve body has no gait that the bodies are to swim with; expected "
                    + "--gait FILE, or --evolve both" : "--gait is for --evolve body; else gaits are evolved");
        }
        return evolve == Evolved.GAIT ? null : new BodyEvolution(evolve,
                SceneInfo.bodyToEvolve(sceneName, sceneOptions.overrides(), simulator), gait == null ? null : GaitFile.read(gait).gait());
    }

    /** With a number of evaluations alone, that is what ends the run. */
    private int generations() {
        return generations != null ? generations
                : evaluations != null ? EvolutionSettings.NO_LIMIT : preset.generations();
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
        String name = Path.of(sceneName).getFileName().toString().replaceFirst("\\.json$", "") + "-seed-" + seed;
        Path folder = Path.of("runs", name);
        for (int number = 2; Files.exists(folder); number++) {
            folder = Path.of("runs", name + "-" + number);
        }
        return folder;
    }
}
