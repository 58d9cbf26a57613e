package io.natator.encoding;

import io.natator.base.Numbers;
import java.util.List;

/**
 * Name and closed range of one gene.
 *
 * @param name  for example {@code frequency} or {@code amplitude 1}
 * @param lower least value
 * @param upper greatest value, above {@code lower}
 */
public record GeneRange(String name, double lower, double upper) {

    static final double MIN_FREQUENCY = 0.5;
    static final double MAX_FREQUENCY = 2.0;

    /** f within [0.5, 2] 1/s (thesis 2.5). */
    static GeneRange frequency() {
        return new GeneRange("frequency", MIN_FREQUENCY, MAX_FREQUENCY);
    }

    /** A gene within [0, 1]: an amplitude, a phase or a phase difference. */
    static GeneRange unit(String name) {
        return new GeneRange(name, 0.0, 1.0);
    }

    /** Upper less lower bound. */
    public double width() {
        return upper - lower;
    }

    /** Whether the value lies in the closed range; never for NaN. */
    public boolean contains(double value) {
        return value >= lower && value <= upper;
    }

    /**
     * Fails unless genes fit their ranges.
     *
     * @throws IllegalArgumentException if there are too few or too many, or one is outside its range
     */
    public static void check(List<GeneRange> ranges, List<Double> genes) {
        if (genes.size() != ranges.size()) {
            throw new IllegalArgumentException(
                    Numbers.count(genes.size(), "gene") + " given; expected " + ranges.size() + ": "
                            + String.join(", ", ranges.stream().map(GeneRange::name).toList()));
        }
        for (int i = 0; i < ranges.size(); i++) {
            GeneRange range = ranges.get(i);
            if (!range.contains(genes.get(i))) {
                throw new IllegalArgumentException("gene " + (i + 1) + " (" + range.name() + ") is " + genes.get(i)
                        + "; expected a number from " + range.lower() + " to " + range.upper());
            }
        }
    }
}
