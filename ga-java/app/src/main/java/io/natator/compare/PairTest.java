package io.natator.compare;

import io.natator.base.Numbers;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Map;
import java.util.stream.IntStream;

/**
 * Two of several samples beside each other.
 *
 * @param first      name of a sample
 * @param second     name of another
 * @param difference of their medians, the first less the second
 * @param test       of their ranks
 * @param p          of the test, corrected for all pairs of these samples
 * @param enough     whether samples of these sizes could show a difference at all
 */
public record PairTest(String first, String second, MedianInterval difference, RankTest test, double p,
        boolean enough) {

    /** From this corrected p on, no difference is seen. */
    public static final double LEVEL = 0.05;
    private static final double MIN_SHOWN = 0.001;

    /**
     * All pairs.
     *
     * @param samples by name, in their order; those without a value are left out
     */
    public static List<PairTest> all(Map<String, double[]> samples) {
        List<String> names = samples.keySet().stream().filter(name -> samples.get(name).length > 0).toList();
        List<PairTest> pairs = new ArrayList<>();
        for (int i = 0; i < names.size(); i++) {
            for (int j = i + 1; j < names.size(); j++) {
                double[] one = samples.get(names.get(i));
                double[] other = samples.get(names.get(j));
                pairs.add(new PairTest(names.get(i), names.get(j), MedianInterval.ofDifference(one, other),
                        RankTest.of(one, other), Double.NaN, false));
            }
        }
        double[] corrected = corrected(pairs.stream().mapToDouble(pair -> pair.test.p()).toArray());
        List<PairTest> all = new ArrayList<>();
        for (int i = 0; i < corrected.length; i++) {
            PairTest pair = pairs.get(i);
            all.add(new PairTest(pair.first, pair.second, pair.difference, pair.test, corrected[i],
                    corrected.length * pair.test.leastP() < LEVEL));
        }
        return all;
    }

    /**
     * Values of p, corrected for several tests at once (Holm 1979): the chance that any of them finds what is not there stays the level.
     *
     * @return for each, in the same order, what to compare with the level
     */
    static double[] corrected(double... p) {
        List<Integer> rising = IntStream.range(0, p.length).boxed().sorted(Comparator.comparingDouble(i -> p[i]))
                .toList();
        double[] corrected = new double[p.length];
        double greatest = 0;
        for (int rank = 0; rank < p.length; rank++) {
            int i = rising.get(rank);
            greatest = Math.max(greatest, Math.min(1, (p.length - rank) * p[i]));
            corrected[i] = greatest;
        }
        return corrected;
    }

    /** Whether test and interval both say that the samples differ. */
    public boolean isSeen() {
        return p < LEVEL && difference.excludesZero();
    }

    /**
     * The result in words: no more than test and interval support.
     *
     * @param greater comparative for the greater sample, such as {@code better than}
     */
    public String verdict(String greater) {
        String why = " (p " + chance(p) + ", A = " + Numbers.fixed(test.a(), 2) + ")";
        if (isSeen()) {
            boolean isFirst = difference.median() > 0;
            return (isFirst ? first : second) + " " + greater + " " + (isFirst ? second : first) + why;
        }
        return enough ? "no difference seen" + why : "too few to tell";
    }

    /** With its sign of relation: {@code = 0.03}, {@code < 0.001}. */
    public static String chance(double p) {
        return p < MIN_SHOWN ? "< " + MIN_SHOWN : "= " + Numbers.fixed(p, p < 0.1 ? 3 : 2);
    }
}
