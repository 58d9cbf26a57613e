package io.natator.encoding;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.RandomCases;
import java.util.ArrayList;
import java.util.List;
import java.util.random.RandomGenerator;

class EncodingProperties {

    @RandomCases(300)
    void everyGenomeGivesAGaitWithinTheThesisRanges(RandomCases.Case one) {
        int actuators = one.whole(2, 12);
        Encoding encoding = one.random().nextBoolean() ? new DenseEncoding(actuators) : new SparseEncoding(actuators);

        Gait gait = encoding.decode(genome(encoding, one.random()));

        assertThat(gait.frequency()).isBetween(0.5, 2.0);
        assertThat(gait.amplitude()).hasSize(actuators).allSatisfy(a -> assertThat(a).isBetween(0.0, 1.0));
        assertThat(gait.phase()).hasSize(actuators).allSatisfy(phi -> assertThat(phi).isBetween(0.0, 1.0));
        assertThat(gait.phase().get(0)).isZero();
    }

    /** Genes at their bounds are likelier than by chance, since mistakes sit there. */
    private static List<Double> genome(Encoding encoding, RandomGenerator random) {
        List<Double> genes = new ArrayList<>();
        for (GeneRange range : encoding.genes()) {
            double inside = range.lower() + random.nextDouble() * range.width();
            int choice = random.nextInt(4);
            genes.add(choice == 0 ? range.lower() : choice == 1 ? range.upper() : inside);
        }
        return genes;
    }
}
