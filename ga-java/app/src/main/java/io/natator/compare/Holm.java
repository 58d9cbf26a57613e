package io.natator.compare;

import java.util.Comparator;
import java.util.List;
import java.util.stream.IntStream;

/** Holm's correction for several tests at once (1979): the chance that any of them finds what is not there stays the level. */
public final class Holm {

    private Holm() {
    }

    /**
     * Corrected values of p.
     *
     * @return for each, in the same order, what to compare with the level
     */
    public static double[] corrected(double... p) {
        List<Integer> rising = IntStream.range(0, p.length).boxed().sorted(Comparator.comparingDouble(i -> p[i])).toList();
        double[] corrected = new double[p.length];
        double greatest = 0;
        for (int rank = 0; rank < p.length; rank++) {
            int i = rising.get(rank);
            greatest = Math.max(greatest, Math.min(1, (p.length - rank) * p[i]));
            corrected[i] = greatest;
        }
        return corrected;
    }
}
