package io.natator.evolution;

import com.fasterxml.jackson.annotation.JsonPropertyOrder;
import java.util.Arrays;

/**
 * Figures of one generation. Distances are in scene units, negative is backwards, and a chromosome whose evaluation was
 * unstable or failed counts as 0.
 *
 * @param generation  0 is the random one
 * @param best        greatest distance
 * @param mean        mean distance
 * @param median      median distance
 * @param worst       least distance
 * @param population  chromosomes in the generation
 * @param evaluations of them newly simulated; the others were unchanged
 * @param unstable    simulations that became unstable
 * @param failed      simulations without a valid answer
 */
@JsonPropertyOrder({"generation", "best", "mean", "median", "worst", "population", "evaluations", "unstable", "failed"})
public record GenerationSummary(int generation, double best, double mean, double median, double worst, int population,
        int evaluations, int unstable, int failed) {

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
}
