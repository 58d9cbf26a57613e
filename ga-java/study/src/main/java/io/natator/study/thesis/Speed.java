package io.natator.study.thesis;

import io.natator.study.Sample;
import org.apache.commons.statistics.distribution.TDistribution;

/**
 * The mean speed of a gait, and how far it is known.
 *
 * @param mean        scene units per second
 * @param scatter     half the width of the mean's 95 % interval by Student's t; 0 of a single run
 * @param halfStep    change at half the time step; NaN if that was not measured
 * @param halfSpacing change at half the spacing of all particles; NaN likewise
 */
record Speed(double mean, double scatter, double halfStep, double halfSpacing) {

    private static final double UPPER = 0.975;

    /**
     * From runs as the scene is and at half its time step.
     *
     * @param change at half the spacing, or NaN
     */
    static Speed of(Sample runs, Sample atHalfStep, double change) {
        return new Speed(runs.mean(), interval(runs), atHalfStep.count() == 0 ? Double.NaN : atHalfStep.mean() - runs.mean(), change);
    }

    /** Half the width of the 95 % interval of a mean; 0 of a single value. */
    static double interval(Sample sample) {
        return sample.hasSpread() ? TDistribution.of(sample.count() - 1).inverseCumulativeProbability(UPPER)
                * sample.standardDeviation() / Math.sqrt(sample.count()) : 0;
    }

    /** The largest of the three: within it the speed stays from other starts, at half the time step and at half the spacing. */
    double error() {
        return Math.max(scatter, Math.max(known(halfStep), known(halfSpacing)));
    }

    private static double known(double change) {
        return Double.isNaN(change) ? 0 : Math.abs(change);
    }

    /** Mean ± error, in a unit of this size. */
    String text(double unit) {
        return TableFormat.withError(mean / unit, error() / unit);
    }

    /** ± scatter, in a unit of this size. */
    String scatterText(double unit) {
        return TableFormat.error(scatter / unit);
    }
}
