package io.natator.encoding;

import java.util.ArrayList;
import java.util.List;

/**
 * Another encoding with one gene more, the offset: how far all muscles are driven to one side beside their beat, so that
 * the swimmer steers.
 *
 * @param straight the other; the offset comes after its genes
 */
public record SteeredEncoding(Encoding straight) implements Encoding {

    private static final GeneRange OFFSET = new GeneRange("offset", -0.5, 0.5);

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
