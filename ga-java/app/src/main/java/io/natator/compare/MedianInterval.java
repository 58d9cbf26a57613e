package io.natator.compare;

import io.natator.base.Numbers;
import java.util.Random;
import java.util.function.Function;
import org.apache.commons.statistics.descriptive.Median;
import org.apache.commons.statistics.descriptive.Quantile;

/**
 * A median, or the difference of two, with its 95 % bootstrap interval: percentiles of the medians of samples that are drawn
 * from the sample with replacement (Efron 1979). The same values give the same interval.
 *
 * @param median of the sample, or median of the first less that of the second
 * @param low    end of the interval; NaN where a sample has a single value
 * @param high   the other end
 */
public record MedianInterval(double median, double low, double high) {

    private static final int RESAMPLES = 10_000;
    private static final long SEED = 20190101;
    private static final double TAIL = 0.025;

    /** Median and interval of a sample with at least one value. */
    public static MedianInterval of(double[] values) {
        return of(median(values), values.length > 1, random -> median(resample(values, random)));
    }

    /** Difference of the medians of two samples with at least one value each, and its interval. */
    public static MedianInterval ofDifference(double[] first, double[] second) {
        return of(median(first) - median(second), first.length > 1 && second.length > 1,
                random -> median(resample(first, random)) - median(resample(second, random)));
    }

    private static MedianInterval of(double median, boolean hasSpread, Function<Random, Double> sample) {
        if (!hasSpread) {
            return new MedianInterval(median, Double.NaN, Double.NaN);
        }
        Random random = new Random(SEED);
        double[] medians = new double[RESAMPLES];
        for (int i = 0; i < RESAMPLES; i++) {
            medians[i] = sample.apply(random);
        }
        double[] ends = Quantile.withDefaults().evaluate(medians, TAIL, 1 - TAIL);
        return new MedianInterval(median, ends[0], ends[1]);
    }

    private static double median(double[] values) {
        return Median.withDefaults().evaluate(values);
    }

    private static double[] resample(double[] values, Random random) {
        return random.ints(values.length, 0, values.length).mapToDouble(i -> values[i]).toArray();
    }

    /** Median and interval with so many decimals, each times a factor: {@code 0.81 [0.70, 0.93]}. */
    public String text(double factor, int decimals) {
        return Numbers.fixed(factor * median, decimals)
                + (Double.isNaN(low) ? "" : " [" + Numbers.fixed(factor * low, decimals)
                        + ", " + Numbers.fixed(factor * high, decimals) + "]");
    }

    /** Whether both ends are known and on the same side of 0. */
    public boolean excludesZero() {
        return low > 0 || high < 0;
    }
}
