package io.natator.encoding;

import java.util.ArrayList;
import java.util.List;

/**
 * Dense encoding (thesis 2.6): frequency, n amplitudes, n − 1 phases. The first phase is fixed at 0, since only
 * differences between phases matter. For creatures with few actuators.
 */
public final class DenseEncoding implements Encoding {

    private final int actuators;
    private final List<GeneRange> genes;

    /**
     * Encoding for a creature.
     *
     * @param actuators n, at least 1
     * @throws IllegalArgumentException if n is less than 1
     */
    public DenseEncoding(int actuators) {
        if (actuators < 1) {
            throw new IllegalArgumentException("dense encoding of " + actuators + " actuators; expected at least 1");
        }
        this.actuators = actuators;
        List<GeneRange> ranges = new ArrayList<>();
        ranges.add(GeneRange.frequency());
        for (int i = 1; i <= actuators; i++) {
            ranges.add(GeneRange.unit("amplitude " + i));
        }
        for (int i = 2; i <= actuators; i++) {
            ranges.add(GeneRange.unit("phase " + i));
        }
        this.genes = List.copyOf(ranges);
    }

    @Override
    public List<GeneRange> genes() {
        return genes;
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
