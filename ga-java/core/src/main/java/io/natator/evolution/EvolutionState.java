package io.natator.evolution;

import com.fasterxml.jackson.annotation.JsonInclude;
import io.natator.base.InvalidInputException;
import io.natator.base.Numbers;
import io.natator.config.EvolutionSettings;
import java.util.List;
import java.util.Objects;

/**
 * All that the next generation depends on, and what is to be told of the ones before: an evolution that continues from
 * here takes the same course as one that was never interrupted.
 *
 * @param generation  number of the last finished generation; 0 is the random one
 * @param evaluations simulations up to now; the next one gets this number as its id
 * @param population  the evaluated chromosomes of that generation
 * @param best        greatest distance of all generations, the earliest of equals; with several starts
 *                    the surest of the champions; null if none was measured
 * @param history     one summary per finished generation
 * @param champions   the best gaits of all generations, which are run again in each; null with a single start
 * @param refused     genes of those that were unstable in some of their runs alone: born again, they are judged by those runs too; null
 *                    without any
 */
public record EvolutionState(int generation, long evaluations, List<Individual> population, Individual best,
        List<GenerationSummary> history, @JsonInclude(JsonInclude.Include.NON_NULL) List<Individual> champions,
        @JsonInclude(JsonInclude.Include.NON_NULL) List<List<Double>> refused) {

    /**
     * Copies the lists.
     *
     * @throws InvalidInputException if the history is not that of all generations
     */
    public EvolutionState {
        population = List.copyOf(Objects.requireNonNull(population, "population"));
        history = List.copyOf(Objects.requireNonNull(history, "history"));
        if (generation < 0 || history.size() != generation + 1L) {
            throw new InvalidInputException("history has " + Numbers.count(history.size(), "generation")
                    + "; expected those from 0 to generation, " + generation);
        }
        champions = champions == null ? null : List.copyOf(champions);
        refused = refused == null ? null : refused.stream().map(List::copyOf).toList();
    }

    /** The state of an evolution in which every gait is run once. */
    public EvolutionState(int generation, long evaluations, List<Individual> population, Individual best,
            List<GenerationSummary> history) {
        this(generation, evaluations, population, best, history, null, null);
    }

    /** Whether an evolution with these settings goes no further than this state: no more whole gait can be evaluated. */
    public boolean isLastOf(EvolutionSettings settings) {
        return generation >= settings.budget().generations()
                || settings.budget().evaluations() != null
                        && evaluations + settings.search().starts() > settings.budget().evaluations();
    }
}
