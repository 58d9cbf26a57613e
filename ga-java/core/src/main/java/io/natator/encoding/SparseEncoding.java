package io.natator.encoding;

import io.natator.base.Numbers;
import java.util.ArrayList;
import java.util.List;

/**
 * Sparse encoding (thesis 2.6): frequency, first amplitude, last amplitude, phase difference. Amplitudes run evenly
 * from the first to the last (eq. 2.9), phases advance by the difference from one actuator to the next (eq. 2.10,
 * counted so that the first phase is 0, as table 2.2 shows). Four genes for any number of actuators.
 *
 * @param actuators of the creature, at least 2: with one there is no last amplitude
 */
public record SparseEncoding(int actuators) implements Encoding {

    private static final List<GeneRange> GENES = List.of(GeneRange.frequency(), GeneRange.unit("first amplitude"),
            GeneRange.unit("last amplitude"), GeneRange.unit("phase difference"));

    /**
     * Checks the number.
     *
     * @throws IllegalArgumentException if there are fewer than 2
     */
    public SparseEncoding {
        if (actuators < 2) {
            throw new IllegalArgumentException(
                    "sparse encoding of " + Numbers.count(actuators, "actuator") + "; expected at least 2");
        }
    }

    @Override
    public List<GeneRange> genes() {
        return GENES;
    }

    @Override
    public Gait decode(List<Double> values) {
        check(values);
        double first = values.get(1);
        double last = values.get(2);
        double difference = values.get(3);
        List<Double> amplitude = new ArrayList<>();
        List<Double> phase = new ArrayList<>();
        for (int i = 0; i < actuators; i++) {
            double share = (double) i / (actuators - 1);
            amplitude.add((1.0 - share) * first + share * last);
            phase.add(i * difference % 1.0);
        }
        return new Gait(values.get(0), amplitude, phase);
    }
}
