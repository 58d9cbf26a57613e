package io.natator.encoding;

import java.util.ArrayList;
import java.util.List;

/**
 * Another encoding with one gene more, the offset: how far all muscles are driven to one side beside their beat, so that
 * the swimmer steers.
 */
public final class SteeredEncoding implements Encoding {

    private static final GeneRange OFFSET = new GeneRange("offset", -0.5, 0.5);

    private final Encoding straight;

    /** The genes of an encoding, and the offset after them. */
    public SteeredEncoding(Encoding straight) {
        this.straight = straight;
    }

    @Override
    public List<GeneRange> genes() {
        List<GeneRange> genes = new ArrayList<>(straight.genes());
        genes.add(OFFSET);
        return List.copyOf(genes);
    }

    @Override
    public Gait decode(List<Double> values) {
        check(values);
        int last = values.size() - 1;
        return straight.decode(values.subList(0, last)).steered(values.get(last));
    }
}
