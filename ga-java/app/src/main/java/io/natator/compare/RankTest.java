package io.natator.compare;

import org.apache.commons.numbers.combinatorics.BinomialCoefficientDouble;
import org.apache.commons.statistics.inference.MannWhitneyUTest;

/**
 * Mann and Whitney's rank test of two samples (1947) with an effect size.
 *
 * @param p      two-sided: exact for small samples without ties, else by the normal distribution with corrections for ties and
 *               continuity
 * @param a      Vargha and Delaney's A (2000): the chance that a value of the first sample is greater than one of the second,
 *               ties counted half; 0.5 is no effect
 * @param leastP the least p that samples of these sizes can have
 */
public record RankTest(double p, double a, double leastP) {

    /** Tests two samples with at least one value each. */
    public static RankTest of(double[] first, double[] second) {
        MannWhitneyUTest.Result result = MannWhitneyUTest.withDefaults().test(first, second);
        double pairs = (double) first.length * second.length;
        double a = result.getStatistic() / pairs;
        // Where all values are equal, the normal distribution has no width.
        double p = Double.isNaN(result.getPValue()) ? 1 : Math.min(1, result.getPValue());
        return new RankTest(p, a,
                Math.min(1, 2 / BinomialCoefficientDouble.value(first.length + second.length, first.length)));
    }
}
