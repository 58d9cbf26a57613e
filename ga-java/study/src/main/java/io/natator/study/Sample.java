package io.natator.study;

import java.util.List;

/**
 * Mean and spread of equal runs.
 *
 * @param count             number of values
 * @param mean              NaN without a value
 * @param standardDeviation with count − 1 in the denominator; NaN for less than two values
 */
public record Sample(int count, double mean, double standardDeviation) {

    /** Of these values. */
    public static Sample of(List<Double> values) {
        int count = values.size();
        double mean = values.stream().mapToDouble(Double::doubleValue).sum() / count;
        double squares = values.stream().mapToDouble(value -> (value - mean) * (value - mean)).sum();
        return new Sample(count, mean, count < 2 ? Double.NaN : Math.sqrt(squares / (count - 1)));
    }

    /** Of the mean; 0 of a single value, which says nothing of its spread. */
    public double standardError() {
        return hasSpread() ? standardDeviation / Math.sqrt(count) : 0;
    }

    /** Whether there are enough values to say how much they scatter. */
    public boolean hasSpread() {
        return count >= 2;
    }
}
