package io.natator.picture;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import java.util.stream.DoubleStream;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;
import org.junit.jupiter.params.provider.EnumSource;

class FromTest {

    private static final double[] CENTRE = {1, 2, 3};

    private static Projection projection(From from) {
        return new Projection(from, CENTRE, 100, new double[] {320, 240});
    }

    /** One unit from the centre along x, y and z: pixels to the right, down and to the viewer. */
    @ParameterizedTest
    @CsvSource({"SIDE,1 0 0,100 0 0", "SIDE,0 1 0,0 -100 0", "SIDE,0 0 1,0 0 100",
        "TOP,1 0 0,100 0 0", "TOP,0 1 0,0 0 100", "TOP,0 0 1,0 100 0",
        "FRONT,1 0 0,0 0 100", "FRONT,0 1 0,0 -100 0", "FRONT,0 0 1,-100 0 0"})
    void aUnitIsWhereItIsSeen(From from, String way, String pixels) {
        String[] along = way.split(" ");
        double[] place = new double[3];
        for (int axis = 0; axis < 3; axis++) {
            place[axis] = CENTRE[axis] + Double.parseDouble(along[axis]);
        }
        Projection seen = projection(from);
        String[] expected = pixels.split(" ");
        assertThat(seen.x(place[0], place[1], place[2]) - 320).isCloseTo(Double.parseDouble(expected[0]), within(1e-9));
        assertThat(seen.y(place[0], place[1], place[2]) - 240).isCloseTo(Double.parseDouble(expected[1]), within(1e-9));
        assertThat(seen.depth(place[0], place[1], place[2])).isCloseTo(Double.parseDouble(expected[2]), within(1e-9));
    }

    @ParameterizedTest
    @EnumSource(From.class)
    void lengthsAreKept(From from) {
        for (int a = 0; a < 3; a++) {
            for (int b = 0; b < 3; b++) {
                double product = 0;
                for (int i = 0; i < 3; i++) {
                    product += from.axis(a)[i] * from.axis(b)[i];
                }
                assertThat(product).isCloseTo(a == b ? 1 : 0, within(1e-12));
            }
        }
    }

    @Test
    void threeQuarterShowsTheRightTheTopAndTheHead() {
        assertThat(DoubleStream.of(From.THREE_QUARTER.axis(2))).allMatch(towards -> towards > 0.3);
    }

    @ParameterizedTest
    @CsvSource({"0.3,0.2", "0.4,0.5", "1,1", "8,10", "0.033,0.05", "14,10"})
    void aScaleIsARoundLength(double wanted, double length) {
        assertThat(Surroundings.roundLength(wanted)).isCloseTo(length, within(1e-12));
    }
}
