package io.natator.flow;

import static org.assertj.core.api.Assertions.assertThat;

import io.natator.flow.Snapshot.Particle;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.provider.CsvSource;

class WaterLevelTest {

    private static Particle at(double x, double y, double z) {
        return new Particle(new double[] {x, y, z}, new double[3]);
    }

    /** A tank of 20 x 10 x 10 particles at distances of 0.1, its surface at 0.9, and a spout of ten up to 2. */
    private static List<Particle> tank() {
        List<Particle> water = new ArrayList<>();
        for (int x = 0; x < 20; x++) {
            for (int y = 0; y < 10; y++) {
                for (int z = 0; z < 10; z++) {
                    water.add(at(0.1 * x, 0.1 * y, 0.1 * z));
                }
            }
        }
        for (int i = 1; i <= 10; i++) {
            water.add(at(0.5, 0.9 + 0.11 * i, 0.5));
        }
        return water;
    }

    /** A column of eleven body particles from its lowest, 0.05 apart. */
    @ParameterizedTest
    @CsvSource({"0.2, 1.0", "0.625, 0.5454545454545454", "0.95, 0.0"})
    void countsWhatIsBelowTheSurfaceDespiteASplash(double lowest, double share) {
        List<Particle> body = new ArrayList<>();
        for (int i = 0; i <= 10; i++) {
            body.add(at(1, lowest + 0.05 * i, 0.5));
        }

        assertThat(WaterLevel.shareBelow(new Snapshot(1, tank(), body))).isEqualTo(share);
    }

    @Test
    void withoutWaterThereIsNoShare() {
        assertThat(WaterLevel.shareBelow(new Snapshot(1, List.of(), List.of(at(0, 0, 0))))).isNull();
        assertThat(WaterLevel.shareBelow(new Snapshot(1, tank(), List.of()))).isNull();
    }
}
