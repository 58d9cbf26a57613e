package io.natator.encoding;

import java.util.ArrayList;
import java.util.List;

/**
 * Dense encoding (thesis 2.6): frequency, n amplitudes, n − 1 phases. The first phase is fixed at 0, since only
 * differences between phases matter. For creatures with few actuators.
 *
 * @param actuators n of the creature, at least 1
 */
public record DenseEncoding(int actuators) implements Encoding {

    /**
     * Checks the number.
     *
     * @throws IllegalArgumentException if it is less than 1
     */
    public DenseEncoding {
        if (actuators < 1) {
            throw new IllegalArgumentException("dense encoding of " + actuators + " actuators; expected at least 1");
        }
    }

    @Override
    public List<GeneRange> genes() {
        List<GeneRange> ranges = new ArrayList<>();
        ranges.add(GeneRange.frequency());
        for (int i = 1; i <= actuators; i++) {
            ranges.add(GeneRange.unit("amplitude " + i));
        }
        for (int i = 2; i <= actuators; i++) {
            ranges.add(GeneRange.unit("phase " + i));
        }
        return List.copyOf(ranges);
    }

    @Override
    public Gait decode(List<Double> values) {
        check(values);
        List<Double> phase = new ArrayList<>();
        phase.add(0.0);
        phase.addAll(values.subList(1 + actuators, values.size()));
        return new Gait(values.get(0), values.subList(1, 1 + actuators), phase);
    }
}
