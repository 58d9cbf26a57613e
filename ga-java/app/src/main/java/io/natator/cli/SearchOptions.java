package io.natator.cli;

import io.natator.cli.Section.Topic;
import io.natator.config.EncodingKind;
import io.natator.config.EvolutionSettings;
import io.natator.config.FitnessKind;
import io.natator.config.OperatorSet;
import io.natator.config.OptimizerKind;
import io.natator.config.WeightedObjective;
import picocli.CommandLine.Option;

/** Options that say what gaits are looked for, and how. */
@Section(Topic.SEARCH)
final class SearchOptions {

    @Option(names = "--optimizer", paramLabel = "NAME", defaultValue = "jgap",
            description = "jgap (the thesis' genetic algorithm), cma-es, random, map-elites (the best of every kind of gait), "
                    + "or for several objectives nsga2. Default: ${DEFAULT-VALUE}.")
    private OptimizerKind optimizer;

    @Option(names = "--seed", paramLabel = "N", defaultValue = "1",
            description = "The same seed gives the same run. Default: ${DEFAULT-VALUE}.")
    private long seed;

    @Option(names = "--operators", paramLabel = "SET", defaultValue = "corrected",
            description = "Genetic operators: corrected, or stock (as JGAP ships them). Default: ${DEFAULT-VALUE}.")
    private OperatorSet operators;

    @Option(names = "--gaussian-deviation", paramLabel = "X", defaultValue = "0.05",
            description = "Deviation of the Gaussian mutation as a share of a gene's range. Default: ${DEFAULT-VALUE}.")
    private double gaussianDeviation;

    @Option(names = "--fitness", paramLabel = "KIND", defaultValue = "distance", description = "What is rewarded: "
            + "distance, or net: less what the gait drifts forwards in vacuum. Default: ${DEFAULT-VALUE}.")
    private FitnessKind fitness;

    @Option(names = "--objectives", paramLabel = "NAME[=WEIGHT],...", description = "What is rewarded instead of --fitness: "
            + "distance, net, forward (by its own heading), straight, work, efficiency. One; several with weights, as a sum; "
            + "for nsga2 several without.")
    private String objectives;

    @Option(names = "--vacuum-check", description = "Run every generation's new best in vacuum too; see vacuum.jsonl.")
    private boolean vacuumCheck;

    @Option(names = "--encoding", paramLabel = "KIND",
            description = "Genes: dense or sparse, or either with an offset to steer by, dense-steered or sparse-steered. Default: the "
                    + "creature's (2 is sparse, the others dense); of goals/… sparse-steered.")
    private EncodingKind encoding;

    /** The encoding of gaits in a scene. */
    EncodingKind encoding(String scene) {
        return encoding != null ? encoding : EncodingKind.usualFor(scene);
    }

    long seed() {
        return seed;
    }

    /** The settings with this search. */
    EvolutionSettings in(EvolutionSettings settings) {
        return settings.withSeed(seed).withOptimizer(OptimizerKind.JGAP, operators, gaussianDeviation).withFitness(fitness, vacuumCheck)
                .withObjectives(optimizer, objectives == null ? null : WeightedObjective.parse(objectives));
    }
}
