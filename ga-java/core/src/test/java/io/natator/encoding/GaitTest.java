package io.natator.encoding;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.List;
import org.assertj.core.data.Offset;
import org.junit.jupiter.api.Test;

class GaitTest {

    private static final Gait GAIT = new Gait(1.5, List.of(0.3, 0.9), List.of(0.0, 0.648));

    /** Every muscle does the opposite at every moment, and phases stay within a period. */
    @Test
    void theMirrorImageContractsTheOtherSide() {
        Gait mirrored = GAIT.mirrored();
        for (double time = 0; time < 1; time += 0.07) {
            for (int i = 0; i < 2; i++) {
                double one = Math.sin(2 * Math.PI * (1.5 * time + GAIT.phase().get(i)));
                double other = Math.sin(2 * Math.PI * (1.5 * time + mirrored.phase().get(i)));
                assertThat(other).isCloseTo(-one, Offset.offset(1e-12));
            }
        }
        assertThat(mirrored.phase()).allMatch(phase -> phase >= 0 && phase <= 1);
        assertThat(mirrored.amplitude()).isEqualTo(GAIT.amplitude());
    }

    @Test
    void restingMusclesHaveNoAmplitude() {
        assertThat(GAIT.resting()).isEqualTo(new Gait(1.5, List.of(0.0, 0.0), GAIT.phase()));
    }
}
