package io.natator.encoding;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import net.jqwik.api.ForAll;
import net.jqwik.api.Property;
import net.jqwik.api.constraints.IntRange;

class EncodingProperties {

    @Property(tries = 300)
    void everyGenomeGivesAGaitWithinTheThesisRanges(@ForAll @IntRange(min = 2, max = 12) int actuators,
            @ForAll boolean dense, @ForAll Random random) {
        Encoding encoding = dense ? new DenseEncoding(actuators) : new SparseEncoding(actuators);

        Gait gait = encoding.decode(genome(encoding, random));

        assertThat(gait.frequency()).isBetween(0.5, 2.0);
        assertThat(gait.amplitude()).hasSize(actuators).allSatisfy(a -> assertThat(a).isBetween(0.0, 1.0));
        assertThat(gait.phase()).hasSize(actuators).allSatisfy(phi -> assertThat(phi).isBetween(0.0, 1.0));
        assertThat(gait.phase().get(0)).isZero();
    }

    /** Genes at their bounds are likelier than by chance, since mistakes sit there. */
    private static List<Double> genome(Encoding encoding, Random random) {
        List<Double> genes = new ArrayList<>();
        for (GeneRange range : encoding.genes()) {
            double inside = range.lower() + random.nextDouble() * range.width();
            int choice = random.nextInt(4);
            genes.add(choice == 0 ? range.lower() : choice == 1 ? range.upper() : inside);
        }
        return genes;
    }
}
