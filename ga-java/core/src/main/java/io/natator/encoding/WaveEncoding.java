package io.natator.encoding;

import java.util.List;

/**
 * A wave from head to tail, as most fish swim by: frequency, first amplitude, last amplitude, waves. Amplitudes run evenly
 * from the first to the last (thesis eq. 2.9); each actuator is {@code waves} / n of a beat later than the one before it.
 * The 0.25 to 1.25 waves are about 0.4 to 1.8 on the whole loach, whose actuators bend 0.56 of it; fish larvae, a mackerel
 * and a lamprey have 0.83 to 1.56 (sim-native/references/swimmers). Standing waves and those to the head, which
 * {@link SparseEncoding} has too, are left out.
 */
public final class WaveEncoding implements Encoding {

    private static final List<GeneRange> GENES = List.of(GeneRange.frequency(), GeneRange.unit("first amplitude"),
            GeneRange.unit("last amplitude"), new GeneRange("waves", 0.25, 1.25));

    private final int actuators;
    private final SparseEncoding sparse;

    /**
     * Encoding for a creature.
     *
     * @param actuators n, at least 2: with one there is no last amplitude
     * @throws IllegalArgumentException if n is less than 2
     */
    public WaveEncoding(int actuators) {
        this.actuators = actuators;
        this.sparse = new SparseEncoding(actuators);
    }

    @Override
    public List<GeneRange> genes() {
        return GENES;
    }

    @Override
    public Gait decode(List<Double> values) {
        check(values);
        double difference = 1.0 - values.get(3) / actuators;
        return sparse.decode(List.of(values.get(0), values.get(1), values.get(2), difference));
    }
}
