package io.natator.config;

import com.fasterxml.jackson.annotation.JsonProperty;
import java.util.List;

/** What a gait is worth whose runs from several starts came out differently. */
public enum Aggregate {
    /** The mean of all runs. */
    @JsonProperty("mean")
    MEAN(1),
    /** The median, which single lucky or failed runs do not move. */
    @JsonProperty("median")
    MEDIAN(3),
    /** The lower quartile: what three of four runs reach, so that a gait that often fails is worth little. */
    @JsonProperty("lower-quartile")
    LOWER_QUARTILE(4);

    private final int leastRuns;

    Aggregate(int leastRuns) {
        this.leastRuns = leastRuns;
    }

    /** From how many runs on it means anything. */
    public int leastRuns() {
        return leastRuns;
    }

    /**
     * The worth of a gait. Quantiles lie between the two nearest runs where they fall between them (type 7 of Hyndman
     * and Fan 1996).
     *
     * @param runs what its runs were worth, at least one, in any order
     */
    public double of(List<Double> runs) {
        return switch (this) {
            case MEAN -> runs.stream().mapToDouble(Double::doubleValue).sum() / runs.size();
            case MEDIAN -> quantile(0.5, runs);
            case LOWER_QUARTILE -> quantile(0.25, runs);
        };
    }

    private static double quantile(double share, List<Double> runs) {
        double[] sorted = runs.stream().mapToDouble(Double::doubleValue).sorted().toArray();
        double place = share * (sorted.length - 1);
        int below = (int) place;
        double next = sorted[Math.min(below + 1, sorted.length - 1)];
        return sorted[below] + (place - below) * (next - sorted[below]);
    }
}
