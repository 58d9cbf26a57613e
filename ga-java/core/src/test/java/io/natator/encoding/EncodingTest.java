package io.natator.encoding;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.natator.body.Bodies;
import java.util.List;
import java.util.SplittableRandom;
import org.junit.jupiter.api.RepeatedTest;
import org.junit.jupiter.api.RepetitionInfo;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class EncodingTest {

    @Test
    void sparsePhasesAreThoseOfTable22() {
        Gait gait = new SparseEncoding(4).decode(List.of(1.0, 0.5, 0.5, 0.4));

        assertThat(gait.phase().get(0)).isZero();
        assertThat(gait.phase().get(1)).isCloseTo(0.4, within(1e-12));
        assertThat(gait.phase().get(2)).isCloseTo(0.8, within(1e-12));
        assertThat(gait.phase().get(3)).isCloseTo(0.2, within(1e-12));
    }

    @Test
    void sparseAmplitudesRunEvenlyFromFirstToLast() {
        // Equation 2.9 with the published gait of creature 2: 0.504 to 0.184 over eight actuators.
        Gait gait = new SparseEncoding(8).decode(List.of(1.338, 0.504, 0.184, 0.431));

        assertThat(gait.frequency()).isEqualTo(1.338);
        assertThat(gait.actuators()).isEqualTo(8);
        assertThat(gait.amplitude().get(0)).isEqualTo(0.504);
        assertThat(gait.amplitude().get(7)).isEqualTo(0.184);
        for (int i = 1; i < 8; i++) {
            assertThat(gait.amplitude().get(i - 1) - gait.amplitude().get(i))
                    .isCloseTo((0.504 - 0.184) / 7, within(1e-12));
        }
    }

    @Test
    void denseGenesAreFrequencyAmplitudesAndAllPhasesButTheFirst() {
        DenseEncoding encoding = new DenseEncoding(3);

        assertThat(encoding.genes()).extracting(GeneRange::name).containsExactly("frequency", "amplitude 1",
                "amplitude 2", "amplitude 3", "phase 2", "phase 3");
        assertThat(encoding.decode(List.of(1.761, 0.863, 0.503, 0.271, 0.176, 0.729)))
                .isEqualTo(new Gait(1.761, List.of(0.863, 0.503, 0.271), List.of(0.0, 0.176, 0.729)));
    }

    @Test
    void bothEncodingsAgreeOnTwoActuators() {
        List<Double> genes = List.of(1.861, 0.973, 0.69, 0.648);

        assertThat(new SparseEncoding(2).decode(genes)).isEqualTo(new DenseEncoding(2).decode(genes));
    }

    /** As the slider of the live page has it. */
    @Test
    void aWaveReachesEachActuatorLaterThanTheOneBeforeIt() {
        Gait gait = new WaveEncoding(5).decode(List.of(2.0, 0.4, 0.2, 0.5));

        assertThat(gait.amplitude()).usingElementComparator(EncodingTest::nearly)
                .containsExactly(0.4, 0.35, 0.3, 0.25, 0.2);
        assertThat(gait.phase()).usingElementComparator(EncodingTest::nearly)
                .containsExactly(0.0, 0.9, 0.8, 0.7, 0.6);
    }

    private static int nearly(double one, double other) {
        return Math.abs(one - other) < 1e-12 ? 0 : Double.compare(one, other);
    }

    @ParameterizedTest
    @CsvSource({"0.49, 0.5, frequency", "2.01, 0.5, frequency", "NaN, 0.5, frequency", "1, -0.1, amplitude 1",
            "1, 1.1, amplitude 1", "1, Infinity, amplitude 1"})
    void genesOutsideTheirRangeAreNamed(double frequency, double amplitude, String name) {
        assertThatThrownBy(() -> new DenseEncoding(1).decode(List.of(frequency, amplitude)))
                .isInstanceOf(IllegalArgumentException.class).hasMessageContaining(name)
                .hasMessageContaining("expected a number from");
    }

    @Test
    void missingGenesAreNamed() {
        assertThatThrownBy(() -> new DenseEncoding(2).decode(List.of(1.0, 0.5, 0.5)))
                .hasMessage("3 genes given; expected 4: frequency, amplitude 1, amplitude 2, phase 2");
    }

    @Test
    void tooFewActuatorsAreRefused() {
        assertThatThrownBy(() -> new DenseEncoding(0)).hasMessageContaining("at least 1");
        assertThatThrownBy(() -> new SparseEncoding(1)).hasMessageContaining("at least 2");
    }

    @Test
    void gaitNeedsAsManyPhasesAsAmplitudes() {
        assertThatThrownBy(() -> new Gait(1.0, List.of(0.5, 0.5), List.of(0.0)))
                .hasMessage("gait has 2 amplitudes and 1 phase; expected as many of both");
    }

    @RepeatedTest(300)
    void everyGenomeGivesAGaitWithinTheThesisRanges(RepetitionInfo seed) {
        SplittableRandom random = new SplittableRandom(seed.getCurrentRepetition());
        int actuators = random.nextInt(2, 13);
        Encoding encoding = switch (random.nextInt(3)) {
            case 0 -> new DenseEncoding(actuators);
            case 1 -> new SparseEncoding(actuators);
            default -> new WaveEncoding(actuators);
        };

        Gait gait = encoding.decode(Bodies.random(encoding.genes(), random));

        assertThat(gait.frequency()).isBetween(0.5, 2.0);
        assertThat(gait.amplitude()).hasSize(actuators).allSatisfy(a -> assertThat(a).isBetween(0.0, 1.0));
        assertThat(gait.phase()).hasSize(actuators).allSatisfy(phi -> assertThat(phi).isBetween(0.0, 1.0));
        assertThat(gait.phase().get(0)).isZero();
    }
}
