package io.natator.evolution;

import io.natator.config.EvolutionSettings;
import io.natator.encoding.GeneRange;
import io.natator.process.OptimizerPipe;
import java.util.List;

/**
 * Proposes genomes, a generation at a time, and learns from their results: {@link #propose}, then {@link #population}. What a
 * generation proposes depends on the settings and on results only, so that a run can continue from what was recorded of it.
 */
interface Optimizer extends AutoCloseable {

    /**
     * Takes note of what was evaluated in earlier generations, when a run continues.
     *
     * @param earlier the newborns of each generation in their order, each as it was before any was run again
     */
    default void recall(List<List<Individual>> earlier) {
    }

    /**
     * Genomes to be evaluated for a generation.
     *
     * @param generation 0 for the first, which knows nothing yet
     * @param before     the individuals of the generation before; empty for the first
     */
    List<List<Double>> propose(int generation, List<Individual> before);

    /**
     * The individuals of the generation.
     *
     * @param newborns what was proposed, in the same order; of that only the first, if the run has had its evaluations
     */
    default List<Individual> population(List<Individual> newborns) {
        return newborns;
    }

    @Override
    default void close() {
    }

    /**
     * The optimizer that the settings name.
     *
     * @param ranges of the genes
     * @param pipe   to an optimizer outside this program; null without one
     */
    static Optimizer of(EvolutionSettings settings, List<GeneRange> ranges, OptimizerPipe pipe) {
        return switch (settings.search().optimizer()) {
            case JGAP -> new GeneticAlgorithm(settings, ranges);
            case CMA_ES -> new CmaEs(settings, ranges);
            case RANDOM -> new RandomSearch(settings, ranges);
            case NSGA2 -> new Nsga2(settings, ranges);
            case MAP_ELITES -> new MapElites(settings, ranges);
            case EXTERNAL -> new ExternalOptimizer(settings, ranges, pipe);
        };
    }
}
