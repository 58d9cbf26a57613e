package io.natator.kinematics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import io.natator.RandomCases;
import java.util.Arrays;
import java.util.List;
import org.junit.jupiter.api.Test;

class SwimmingTest {

    /** z = 0.02 cos(2π·3 x / L) has no slope: the envelope of a standing wave is its amplitude. */
    @Test
    void envelopeOfAStandingWave() {
        double length = SyntheticSwimmer.LENGTH;
        Swimming swimming = new Swimming(SyntheticSwimmer.path(
                (x, t) -> 0.02 * Math.cos(6 * Math.PI * x / length) * Math.cos(2 * Math.PI * SyntheticSwimmer.FREQUENCY * t),
                0, 0.1));

        assertThat(swimming.envelope(length / 3)).isCloseTo(0.02, within(1e-3));
        assertThat(swimming.envelope(length / 12)).isCloseTo(0, within(1e-3));
        assertThat(swimming.measuredLength()).isCloseTo(length, within(1e-2));
    }

    @Test
    void interpolatesBetweenSlices() {
        double[][][] zigzag = {{{0, 0, 1}, {-1, 0, -1}, {-2, 0, -1}, {-3, 0, 1}}};
        Swimming swimming = new Swimming(new SpinePath(new double[] {0}, zigzag));

        assertThat(swimming.lateral(0, 0.25)).isCloseTo(0.5, within(1e-12));
        assertThat(swimming.lateral(0, 1.5)).isCloseTo(-1, within(1e-12));
        assertThat(swimming.lateral(0, 2.75)).isCloseTo(0.5, within(1e-12));
        assertThat(swimming.length()).isCloseTo(1 + 2 * Math.sqrt(5), within(1e-12));
    }

    /** A straight body at rest lies on its line of best fit, head first, whatever its heading. */
    @RandomCases(50)
    void aStraightBodyHasNoLateralMotion(RandomCases.Case one) {
        double heading = one.number(-3.1, 3.1);
        Swimming swimming = new Swimming(SyntheticSwimmer.path((x, t) -> 0, heading, 0.3));

        assertThat(swimming.envelope(0.7)).isCloseTo(0, within(1e-12));
        double[][] line = swimming.line(5);
        assertThat(line[0][0]).isZero();
        assertThat(line[0][line[0].length - 1]).isCloseTo(SyntheticSwimmer.LENGTH, within(1e-9));
    }

    /** A body that bends to its side while it lies on its side. */
    @Test
    void theRollIsTakenOut() {
        SpinePath upright = SyntheticSwimmer.path((x, t) -> 0.1 * x * Math.sin(8 * t), 0, 0);
        List<Attitude> tipping = Arrays.stream(upright.times()).mapToObj(time -> new Attitude(0.7 * time, 0, 0)).toList();
        double[][][] tipped = new double[upright.frames()][][];
        for (int frame = 0; frame < tipped.length; frame++) {
            double roll = tipping.get(frame).roll();
            tipped[frame] = Arrays.stream(upright.centres()[frame]).map(place -> turned(place, 0, roll))
                    .toArray(double[][]::new);
        }

        SpinePath back = new SpinePath(upright.times(), tipped).unrolled(tipping);

        for (int frame = 0; frame < tipped.length; frame += 20) {
            for (int slice = 0; slice < SyntheticSwimmer.SLICES; slice += 6) {
                assertThat(back.centres()[frame][slice]).containsExactly(upright.centres()[frame][slice], within(1e-12));
            }
        }
    }

    /** A body turned by known angles, one after the other about x, y and z, says them. */
    @RandomCases(100)
    void attitudeIsFound(RandomCases.Case one) {
        double roll = one.number(-1.5, 1.5);
        double yaw = one.number(-1.5, 1.5);
        double pitch = one.number(-1.5, 1.5);
        double[][] start = {{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0, 0, 1}, {1, 1, 2}};
        double[][] now = new double[start.length][];
        for (int i = 0; i < start.length; i++) {
            now[i] = turned(turned(turned(start[i], 0, roll), 1, yaw), 2, pitch);
            now[i][0] += 5;
        }

        Attitude attitude = Attitude.of(start, now);

        assertThat(attitude.roll()).isCloseTo(roll, within(1e-9));
        assertThat(attitude.yaw()).isCloseTo(yaw, within(1e-9));
        assertThat(attitude.pitch()).isCloseTo(pitch, within(1e-9));
    }

    /** Right-handed rotation about an axis. */
    private static double[] turned(double[] place, int axis, double angle) {
        int first = (axis + 1) % 3;
        int second = (axis + 2) % 3;
        double[] result = place.clone();
        result[first] = Math.cos(angle) * place[first] - Math.sin(angle) * place[second];
        result[second] = Math.sin(angle) * place[first] + Math.cos(angle) * place[second];
        return result;
    }
}
