package io.natator.evolution;

import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.annotation.JsonPropertyOrder;
import io.natator.protocol.SimulationResult;
import io.soabase.recordbuilder.core.RecordBuilder;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.SortedMap;
import java.util.TreeMap;
import java.util.stream.Collectors;
import java.util.stream.Stream;

/**
 * Figures of one generation. Distances are in scene units, negative is backwards, and a chromosome whose evaluation was
 * unstable or failed counts as 0. Where gaits are worth something else it is left out of best, mean, median and worst: what it is
 * worth by a run's objectives is none of their values, and by goals others may be worth less than 0.
 *
 * @param generation  0 is the random one
 * @param best        greatest distance, or worth by the run's objectives or the scene's goals
 * @param mean        mean of them
 * @param median      median of them
 * @param worst       the least
 * @param population  chromosomes in the generation
 * @param evaluations simulations for it
 * @param unstable    simulations that became unstable
 * @param failed      simulations without a valid answer
 * @param unchanged   of the chromosomes, those that were not newly simulated
 * @param laws        of the unstable simulations, how many broke which law; null without any
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
@RecordBuilder
@JsonPropertyOrder({"generation", "best", "mean", "median", "worst", "population", "evaluations", "unstable", "failed",
        "unchanged", "laws"})
public record GenerationSummary(int generation, double best, double mean, double median, double worst, int population,
        int evaluations, int unstable, int failed, int unchanged, SortedMap<String, Integer> laws)
        implements GenerationSummaryBuilder.With {
    /** No law that was broken is null. */
    public GenerationSummary {
        laws = laws == null || laws.isEmpty() ? null : laws;
    }

    /** A summary without a count of what was unchanged. */
    public GenerationSummary(int generation, double best, double mean, double median, double worst, int population,
            int evaluations, int unstable, int failed) {
        this(generation, best, mean, median, worst, population, evaluations, unstable, failed, 0, null);
    }

    /** Summarises a population, at least one. */
    static GenerationSummary of(int generation, List<Individual> population, int evaluations, int unstable,
            int failed) {
        List<Individual> measured = population.stream().filter(Individual::isMeasured).toList();
        boolean distances = measured.stream().allMatch(Individual::isDistance);
        double[] scores = (distances ? population : measured).stream().mapToDouble(Individual::score).toArray();
        return of(generation, scores, evaluations, unstable, failed).withPopulation(population.size());
    }

    /**
     * Summarises the distances of all chromosomes of a generation.
     *
     * @throws IllegalArgumentException if there are none
     */
    public static GenerationSummary of(int generation, double[] distances, int evaluations, int unstable, int failed) {
        if (distances.length == 0) {
            throw new IllegalArgumentException("generation " + generation + " has no chromosomes");
        }
        double[] sorted = distances.clone();
        Arrays.sort(sorted);
        int count = sorted.length;
        double median = (sorted[(count - 1) / 2] + sorted[count / 2]) / 2.0;
        double mean = Arrays.stream(sorted).sum() / count;
        return new GenerationSummary(generation, sorted[count - 1], mean, median, sorted[0], count, evaluations,
                unstable, failed);
    }

    /** How many of its simulations broke which law; those that are not told of by law were not finite. */
    public SortedMap<String, Integer> brokenLaws() {
        SortedMap<String, Integer> all = new TreeMap<>(laws == null ? Map.of() : laws);
        int untold = unstable - all.values().stream().mapToInt(Integer::intValue).sum();
        if (untold > 0) {
            all.merge(SimulationResult.Instability.FINITE, untold, Integer::sum);
        }
        return all;
    }

    /** One row per generation, as in {@code generations.csv}. Doubles have all their digits; nothing in it depends on time. */
    public static String csv(List<GenerationSummary> history) {
        StringBuilder csv = new StringBuilder(
                "generation,best,mean,median,worst,population,evaluations,unstable,failed\n");
        history.forEach(
                row -> csv.append(Stream
                        .of(row.generation, row.best, row.mean, row.median, row.worst, row.population, row.evaluations,
                                row.unstable, row.failed)
                        .map(Object::toString).collect(Collectors.joining(",", "", "\n"))));
        return csv.toString();
    }

}
