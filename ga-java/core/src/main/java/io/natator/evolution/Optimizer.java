package io.natator.evolution;

import io.natator.config.EvolutionSettings;
import io.natator.encoding.GeneRange;
import java.util.List;

/**
 * Proposes genomes, a generation at a time, and learns from their results. What a generation proposes depends on the
 * settings and on results only, so that a run can continue from what was recorded of it.
 */
interface Optimizer extends AutoCloseable {

    /**
     * Takes note of what was evaluated in earlier generations, when a run continues.
     *
     * @param earlier all newborns in their order, each as it was before any was run again
     */
    default void recall(List<Individual> earlier) {
    }

    /**
     * Proposes and evaluates a generation.
     *
     * @param generation 0 for the first, which knows nothing yet
     * @param before     the individuals of the generation before; empty for the first
     * @return its individuals
     */
    List<Individual> next(int generation, List<Individual> before);

    @Override
    default void close() {
    }

    /**
     * The optimizer that the settings name.
     *
     * @param ranges    of the genes
     * @param evaluator simulates what it proposes
     */
    static Optimizer of(EvolutionSettings settings, List<GeneRange> ranges, GenerationEvaluator evaluator) {
        return switch (settings.search().optimizer()) {
            case JGAP -> new GeneticAlgorithm(settings, ranges, evaluator);
            case CMA_ES -> new CmaEs(settings, ranges, evaluator);
            case RANDOM -> new RandomSearch(settings, ranges, evaluator);
            case NSGA2 -> new Nsga2(settings, ranges, evaluator);
            case MAP_ELITES -> new MapElites(settings, ranges, evaluator);
        };
    }
}
