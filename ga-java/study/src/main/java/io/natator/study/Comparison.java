package io.natator.study;

import java.util.List;

/**
 * Mean speeds of one variant over one interval, in scene units per second.
 *
 * @param flex     what NVIDIA Flex gave, from the start as stated
 * @param ours     what our simulator gave, from starts that differ invisibly
 * @param asStated what it gave from the start as stated; NaN if it did not
 */
record Comparison(Variant variant, Interval interval, Sample flex, Sample ours, double asStated) {

    static Comparison of(Variant variant, Interval interval, List<Double> ourSpeeds, List<Double> asStated) {
        List<Double> flexSpeeds = variant.flexRuns().stream().map(run -> run.speed(interval)).toList();
        return new Comparison(variant, interval, Sample.of(flexSpeeds), Sample.of(ourSpeeds), Sample.of(asStated).mean());
    }

    /** Ours minus theirs. */
    double difference() {
        return ours.mean() - flex.mean();
    }

    /** The same of the start as stated. */
    double differenceAsStated() {
        return asStated - flex.mean();
    }

    /**
     * How much the difference of two single runs, one of each side, scatters: √(s_flex² + s_ours²). Where Flex ran only
     * once its scatter is not known, and is taken to be ours. NaN without at least two of our runs.
     */
    double spread() {
        return Math.hypot(flexDeviation(), ours.standardDeviation());
    }

    /** The difference in units of {@link #spread()}. */
    double differenceInSpreads() {
        return difference() / spread();
    }

    /** Standard error of the difference of the two means, √(s_flex²/n_flex + s_ours²/n_ours), the scatter as above. */
    double standardError() {
        return Math.hypot(flexDeviation() / Math.sqrt(flex.count()),
                ours.standardDeviation() / Math.sqrt(ours.count()));
    }

    private double flexDeviation() {
        return flex.hasSpread() ? flex.standardDeviation() : ours.standardDeviation();
    }
}
