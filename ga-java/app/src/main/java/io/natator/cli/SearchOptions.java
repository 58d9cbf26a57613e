package io.natator.cli;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.base.InvalidInputException;
import io.natator.cli.Section.Topic;
import io.natator.config.Aggregate;
import io.natator.config.BodyEvolution;
import io.natator.config.Budget;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.Evolved;
import io.natator.config.FitnessKind;
import io.natator.config.OperatorSet;
import io.natator.config.OptimizerKind;
import io.natator.config.Preset;
import io.natator.config.Problem;
import io.natator.config.Scheme;
import io.natator.config.WeightedObjective;
import io.natator.process.SceneInfo;
import java.nio.file.Path;
import java.util.List;
import picocli.CommandLine.Option;

/** Options that say what is looked for, how, and how much is simulated for it. */
@Section(Topic.SEARCH)
final class SearchOptions {

    @Section(Topic.EXTENT)
    @Option(names = "--preset", paramLabel = "PRESET", defaultValue = "quick",
            description = "quick (population 20, 3 generations of 4 s in plane/loach, for distance less 0.00005 of the work; 16 of 2 s "
                    + "in pool/creature-N; 1 start) or thesis (150, 100, as thesis/creature-N has it, 4 starts). Other options change parts of it. "
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
    @Option(names = "--starts", paramLabel = "K",
            description = "Run every gait from so many starts, from 1, and the best "
                    + "of each generation again from others; 1 is the scene's own start, once. Default: the preset's.")
    private Integer starts;

    @Option(names = "--judge", paramLabel = "HOW", defaultValue = "mean",
            description = "What the runs of a gait are worth: "
                    + "mean, median (from 3 starts) or lower-quartile (from 4). Default: ${DEFAULT-VALUE}.")
    private Aggregate judge;

    @Option(names = "--evolve", paramLabel = "WHAT", defaultValue = "gait",
            description = "gait, body or both: of a creature "
                    + "that is given by a profile, its length, sections, joints, stiffness and muscle strength too, with the scene's volume "
                    + "and strength in all. Default: ${DEFAULT-VALUE}.")
    private Evolved evolve;

    @Option(names = "--gait", paramLabel = "FILE",
            description = "With --evolve body: what all bodies swim with, a JSON file with a "
                    + "gait or a run's best.json.")
    private Path gait;

    @Option(names = "--optimizer", paramLabel = "NAME", defaultValue = "jgap",
            description = "jgap (the thesis' genetic algorithm), cma-es, random, map-elites (the best of every kind of gait), "
                    + "external (another program, which speaks on standard input and output), or for several objectives nsga2. Default: ${DEFAULT-VALUE}.")
    private OptimizerKind optimizer;

    @Option(names = "--seed", paramLabel = "N", defaultValue = "1",
            description = "The same seed gives the same run. Default: ${DEFAULT-VALUE}.")
    private long seed;

    @Option(names = "--operators", paramLabel = "SET", defaultValue = "corrected",
            description = "Genetic operators: corrected, or stock (as JGAP ships them). Default: ${DEFAULT-VALUE}.")
    private OperatorSet operators;

    @Option(names = "--fitness", paramLabel = "KIND", description = "What is rewarded: "
            + "distance, or net: less what the gait drifts forwards in vacuum. Default: the preset's, else distance.")
    private FitnessKind fitness;

    @Option(names = "--objectives", paramLabel = "NAME[=WEIGHT],...",
            description = "What is rewarded instead of --fitness: "
                    + "distance, net, forward (by its own heading), straight, work, efficiency. One; several with weights, as a sum; "
                    + "for nsga2 several without.")
    private String objectives;

    @Option(names = "--vacuum-check", description = "Run every generation's new best in vacuum too; see vacuum.jsonl.")
    private boolean vacuumCheck;

    @Option(names = "--encoding", paramLabel = "KIND",
            description = "Genes: dense, sparse or wave; dense or sparse with an offset to steer by, dense-steered or sparse-steered. "
                    + "Default: the creature's (2 is sparse, the others dense); of plane/… wave, of goals/… sparse-steered.")
    private EncodingKind encoding;

    /** What is meant where no other option says otherwise. */
    Preset preset() {
        return preset;
    }

    /** The encoding of gaits in a scene. */
    EncodingKind encoding(String scene) {
        return encoding != null ? encoding : EncodingKind.usualFor(scene);
    }

    long seed() {
        return seed;
    }

    /**
     * The settings with this search.
     *
     * @param overrides of the scene, or null
     * @param simulator the native program
     */
    EvolutionSettings in(EvolutionSettings settings, JsonNode overrides, Path simulator) throws InterruptedException {
        // With a number of evaluations alone, that is what ends the run.
        int last = generations != null ? generations : evaluations != null ? Budget.NO_LIMIT : preset.generations();
        String scene = settings.problem().scene();
        return settings.withSize(population != null ? population : preset.population(scene), last)
                .withEvaluations(evaluations)
                .withStarts(starts != null ? starts : preset.starts(), judge).withSeed(seed)
                .withOptimizer(settings.search().optimizer(), operators, settings.search().gaussianDeviation())
                .withFitness(fitness != null ? fitness : FitnessKind.DISTANCE, vacuumCheck)
                .withObjectives(optimizer, objectives(settings.problem()))
                .withEvolve(body(scene, overrides, simulator));
    }

    /** What is rewarded instead of the fitness; null for nothing else. */
    private List<WeightedObjective> objectives(Problem problem) {
        if (objectives != null) {
            return WeightedObjective.parse(objectives);
        }
        boolean isOtherwise = fitness != null || optimizer.takesSeveralObjectives() || optimizer.mapsKinds()
                || optimizer.isOutside() || problem.scheme() == Scheme.FLEX;
        return isOtherwise ? null : preset.objectives(problem.scene());
    }

    /** What to change of the body; null for nothing. */
    private BodyEvolution body(String scene, JsonNode overrides, Path simulator) throws InterruptedException {
        if ((evolve == Evolved.BODY) != (gait != null)) {
            throw new InvalidInputException(
                    gait == null ? "--evolve body has no gait that the bodies are to swim with; expected "
                            + "--gait FILE, or --evolve both" : "--gait is for --evolve body; else gaits are evolved");
        }
        return evolve == Evolved.GAIT ? null : new BodyEvolution(evolve,
                SceneInfo.bodyToEvolve(scene, overrides, simulator), gait == null ? null : GaitFile.read(gait).gait());
    }
}
