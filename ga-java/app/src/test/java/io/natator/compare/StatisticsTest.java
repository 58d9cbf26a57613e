package io.natator.compare;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.stream.DoubleStream;
import org.junit.jupiter.api.Test;

/** Against values of textbooks, of R and scipy, and what follows from a formula. */
class StatisticsTest {

    /** R's help page of wilcox.test, Hollander and Wolfe's data on placental permeability: W = 35; one-sided p = 0.1272. */
    @Test
    void theRankTestIsThatOfR() {
        double[] term = {0.80, 0.83, 1.89, 1.04, 1.45, 1.38, 1.91, 1.64, 0.73, 1.46};
        double[] early = {1.15, 0.88, 0.90, 0.74, 1.21};

        RankTest test = RankTest.of(term, early);

        assertThat(test.a()).isEqualTo(35.0 / 50);
        assertThat(test.p()).isCloseTo(2 * 0.1272, within(1e-4));
    }

    /** Two of 20 choose 10 orders are as extreme as a clean separation; equal rank sums are no evidence at all. */
    @Test
    void theExtremesAreExact() {
        double[] low = DoubleStream.iterate(0, x -> x + 1).limit(10).toArray();
        double[] high = DoubleStream.of(low).map(x -> x + 100).toArray();

        RankTest apart = RankTest.of(high, low);
        assertThat(apart.p()).isCloseTo(2.0 / 184_756, within(1e-15));
        assertThat(apart.leastP()).isCloseTo(apart.p(), within(1e-15));
        assertThat(apart.a()).isEqualTo(1);

        RankTest even = RankTest.of(new double[] {1, 4, 5, 8}, new double[] {2, 3, 6, 7});
        assertThat(even.p()).isEqualTo(1);
        assertThat(even.a()).isEqualTo(0.5);
        RankTest equal = RankTest.of(new double[] {2, 2, 2}, new double[] {2, 2, 2, 2});
        assertThat(equal.p()).isEqualTo(1);
        assertThat(equal.a()).isEqualTo(0.5);
    }

    /** R: p.adjust(c(0.01, 0.04, 0.03, 0.005), "holm"). */
    @Test
    void holmsCorrectionIsThatOfR() {
        assertThat(PairTest.corrected(0.01, 0.04, 0.03, 0.005)).containsExactly(new double[] {0.03, 0.06, 0.06, 0.02},
                within(1e-15));
        assertThat(PairTest.corrected(0.6, 0.7)).containsExactly(1, 1);
        assertThat(PairTest.corrected()).isEmpty();
    }

    /**
     * The median of five drawn of 1, 2, … 5 is 1 if at least three are: with the chance 0.2³·(10·0.64 + 5·0.16 + 0.04) = 0.058,
     * more than a tail of 2.5 %; so the interval is all of it.
     */
    @Test
    void theBootstrapIntervalOfFewValuesIsExact() {
        assertThat(MedianInterval.of(new double[] {3, 1, 5, 2, 4})).isEqualTo(new MedianInterval(3, 1, 5));
        assertThat(MedianInterval.of(new double[] {7, 7, 7})).isEqualTo(new MedianInterval(7, 7, 7));
        assertThat(MedianInterval.of(new double[] {7}).low()).isNaN();
        MedianInterval apart = MedianInterval.ofDifference(new double[] {11, 12, 13}, new double[] {1, 2, 3});
        assertThat(apart).isEqualTo(new MedianInterval(10, 8, 12));
        assertThat(apart.excludesZero()).isTrue();
        assertThat(MedianInterval.ofDifference(new double[] {2}, new double[] {1}).excludesZero()).isFalse();
    }

    /** The interval of the median of samples of 25 holds the true one in about 95 of 100 cases. */
    @Test
    void theBootstrapIntervalCoversTheMedian() {
        Random random = new Random(5);
        int covered = 0;
        for (int i = 0; i < 100; i++) {
            MedianInterval interval = MedianInterval.of(random.doubles(25).toArray());
            covered += interval.low() <= 0.5 && 0.5 <= interval.high() ? 1 : 0;
        }

        assertThat(covered).isBetween(89, 99);
    }

    @Test
    void verdictsSayNoMoreThanTestAndIntervalSupport() {
        Random random = new Random(3);
        Map<String, double[]> samples = new LinkedHashMap<>();
        samples.put("a", random.doubles(10).toArray());
        samples.put("b", random.doubles(10).map(x -> x + 2).toArray());
        samples.put("none", new double[0]);
        samples.put("c", random.doubles(10).toArray());

        List<PairTest> pairs = PairTest.all(samples);

        assertThat(pairs).extracting(pair -> pair.first() + pair.second()).containsExactly("ab", "ac", "bc");
        assertThat(pairs.get(0).verdict("further than")).isEqualTo("b further than a (p < 0.001, A = 0.00)");
        assertThat(pairs.get(0).p()).isCloseTo(3 * 2.0 / 184_756, within(1e-15));
        assertThat(pairs.get(1).verdict("further than")).startsWith("no difference seen (p = ");
        assertThat(pairs.get(2).verdict("further than")).isEqualTo("b further than c (p < 0.001, A = 1.00)");
    }

    /** Three runs against three can never come below 0.1. */
    @Test
    void whereNoTestCouldSeeADifferenceNoneIsDenied() {
        List<PairTest> pairs = PairTest.all(Map.of("a", new double[] {1, 2, 3}, "b", new double[] {11, 12, 13}));

        assertThat(pairs.get(0).test().leastP()).isCloseTo(0.1, within(1e-12));
        assertThat(pairs.get(0).verdict("further than")).isEqualTo("too few to tell");
    }
}
