package io.natator.process;

import static org.assertj.core.api.Assertions.assertThat;

import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class SnapshotTest {

    /** A tank of 20 x 10 x 10 particles at distances of 0.1, its surface at 0.9, and a spout of ten up to 2. */
    private static List<double[]> tank() {
        List<double[]> water = new ArrayList<>();
        for (int i = 0; i < 2000; i++) {
            water.add(new double[] {0.1 * (i / 100), 0.1 * (i / 10 % 10), 0.1 * (i % 10)});
        }
        for (int i = 1; i <= 10; i++) {
            water.add(new double[] {0.5, 0.9 + 0.11 * i, 0.5});
        }
        return water;
    }

    /** A column of eleven body particles from its lowest, 0.05 apart. */
    @ParameterizedTest
    @CsvSource({"0.2, 1.0", "0.625, 0.5454545454545454", "0.95, 0.0"})
    void countsWhatIsBelowTheSurfaceDespiteASplash(double lowest, double share) {
        List<double[]> body = new ArrayList<>();
        for (int i = 0; i <= 10; i++) {
            body.add(new double[] {1, lowest + 0.05 * i, 0.5});
        }

        assertThat(new Snapshot(tank(), body).shareUnderWater()).isEqualTo(share);
    }

    @Test
    void withoutWaterThereIsNoShare() {
        assertThat(new Snapshot(List.of(), List.of(new double[3])).shareUnderWater()).isNull();
        assertThat(new Snapshot(tank(), List.of()).shareUnderWater()).isNull();
    }
}
