package io.natator.encoding;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.RandomCases;
import io.natator.body.Bodies;

class EncodingProperties {

    @RandomCases(300)
    void everyGenomeGivesAGaitWithinTheThesisRanges(RandomCases.Case one) {
        int actuators = one.whole(2, 12);
        Encoding encoding = one.random().nextBoolean() ? new DenseEncoding(actuators) : new SparseEncoding(actuators);

        Gait gait = encoding.decode(Bodies.random(encoding.genes(), one.random()));

        assertThat(gait.frequency()).isBetween(0.5, 2.0);
        assertThat(gait.amplitude()).hasSize(actuators).allSatisfy(a -> assertThat(a).isBetween(0.0, 1.0));
        assertThat(gait.phase()).hasSize(actuators).allSatisfy(phi -> assertThat(phi).isBetween(0.0, 1.0));
        assertThat(gait.phase().get(0)).isZero();
    }
}
