package io.natator.evolution;

import io.natator.config.EvolutionSettings;
import java.util.List;

/**
 * All that the next generation depends on, and what is to be told of the ones before: an evolution that continues from
 * here takes the same course as one that was never interrupted.
 *
 * @param generation  number of the last finished generation; 0 is the random one
 * @param evaluations simulations up to now; the next one gets this number as its id
 * @param population  the evaluated chromosomes of that generation
 * @param best        greatest distance of all generations, the earliest of equals; null if none was measured
 * @param history     one summary per finished generation
 */
public record EvolutionState(int generation, long evaluations, List<Individual> population, Individual best,
        List<GenerationSummary> history) {

    /** Copies the lists. */
    public EvolutionState {
        population = List.copyOf(population);
        history = List.copyOf(history);
    }

    /** Whether an evolution with these settings goes no further than this state. */
    public boolean isLastOf(EvolutionSettings settings) {
        return generation >= settings.generations()
                || settings.evaluations() != null && evaluations >= settings.evaluations();
    }
}
