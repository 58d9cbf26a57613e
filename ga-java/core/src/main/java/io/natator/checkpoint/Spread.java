package io.natator.checkpoint;

import java.util.List;

/**
 * Mean and standard deviation of a sample.
 *
 * @param mean of all values
 * @param sd   standard deviation with n - 1; 0 of a single value
 */
public record Spread(double mean, double sd) {

    /** Mean and deviation of at least one value. */
    public static Spread of(List<Double> values) {
        double mean = values.stream().mapToDouble(Double::doubleValue).average().orElseThrow();
        double squares = values.stream().mapToDouble(value -> (value - mean) * (value - mean)).sum();
        return new Spread(mean, values.size() < 2 ? 0 : Math.sqrt(squares / (values.size() - 1)));
    }

    /** Standard error of the mean of so many values. */
    public double standardError(int count) {
        return sd / Math.sqrt(count);
    }

    /** The spread of values that are so many times as large. */
    public Spread times(double factor) {
        return new Spread(mean * factor, sd * Math.abs(factor));
    }
}
