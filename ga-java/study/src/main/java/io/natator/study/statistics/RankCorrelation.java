package io.natator.study.statistics;

import org.hipparchus.stat.correlation.SpearmansCorrelation;

/** How well one ranking tells another. */
public final class RankCorrelation {

    private RankCorrelation() {
    }

    /**
     * Spearman's correlation, with mean ranks for ties.
     *
     * @param second as many values as the first
     * @return NaN for fewer than two values, and where all of a side are equal
     */
    public static double of(double[] first, double[] second) {
        return first.length < 2 ? Double.NaN : new SpearmansCorrelation().correlation(first, second);
    }
}
