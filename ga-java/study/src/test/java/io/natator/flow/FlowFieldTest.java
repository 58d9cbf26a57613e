package io.natator.flow;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

import io.natator.config.InvalidInputException;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.function.UnaryOperator;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

class FlowFieldTest {

    @TempDir
    private Path folder;

    /** A lattice of fluid with a velocity by place, and a body in its middle. */
    private static Snapshot fluid(UnaryOperator<double[]> velocity) {
        List<Snapshot.Particle> fluid = new ArrayList<>();
        for (int i = 0; i < 20; i++) {
            for (int j = 0; j < 7; j++) {
                for (int k = 0; k < 12; k++) {
                    double[] place = {0.09 * i, 0.09 * j, 0.09 * k};
                    fluid.add(new Snapshot.Particle(place, velocity.apply(place)));
                }
            }
        }
        return new Snapshot(2, fluid, List.of(new Snapshot.Particle(new double[] {0.9, 0.27, 0.5}, new double[3])));
    }

    @Test
    void aStreamHasItsVelocityAndNoVorticity() {
        FlowField field = FlowField.of(fluid(place -> new double[] {0.3, 5, -0.1}), SlicePlane.ABOVE);

        assertThat(field.columns()).isEqualTo(20);
        assertThat(field.rows()).isEqualTo(12);
        assertThat(field.velocity()[7][3]).containsExactly(new double[] {0.3, -0.1}, within(1e-12));
        assertThat(field.vorticity(7, 3)).isCloseTo(0, within(1e-12));
        assertThat(field.body()).isDeepEqualTo(new double[][] {{0.9, 0.5}});
        assertThat(field.time()).isEqualTo(2);
    }

    /** v = Ω × r has the vorticity 2 Ω everywhere. About y, x turns to −z: up in the picture, where z points down. */
    @Test
    void aRigidRotationHasTwiceItsRate() {
        double rate = 1.5;
        FlowField above = FlowField.of(fluid(place -> new double[] {rate * place[2], 0, -rate * place[0]}),
                SlicePlane.ABOVE);
        FlowField side = FlowField.of(fluid(place -> new double[] {-rate * place[1], rate * place[0], 0}),
                SlicePlane.SIDE);

        assertThat(above.vorticity(10, 6)).isCloseTo(2 * rate, within(1e-9));
        assertThat(side.vorticity(10, 3)).isCloseTo(2 * rate, within(1e-9));
        assertThat(side.vorticity(0, 0)).isBetween(rate, 3 * rate);
    }

    @Test
    void whereThereIsNoFluidThereIsNoVelocity() {
        Snapshot whole = fluid(place -> new double[3]);
        Snapshot gap = new Snapshot(0, whole.fluid().stream().filter(one -> Math.abs(one.position()[0] - 0.9) > 0.4).toList(),
                whole.body());

        FlowField field = FlowField.of(gap, SlicePlane.ABOVE);

        assertThat(field.velocity()[10][5]).isNull();
        assertThat(field.vorticity(10, 5)).isNaN();
        assertThat(field.velocity()[0][0]).isNotNull();
    }

    @Test
    void readsASnapshotAndSaysWhatIsWrongWithIt() throws IOException {
        Path file = folder.resolve("snapshot.csv");
        Files.writeString(file, """
                time,kind,mass,x,y,z,vx,vy,vz,density
                1.5,body,1,0.1,0.2,0.3,1,2,3,0
                1.5,fluid,0.5,0.4,0.5,0.6,4,5,6,1
                """);

        Snapshot snapshot = Snapshot.read(file);

        assertThat(snapshot.time()).isEqualTo(1.5);
        assertThat(snapshot.body().get(0).position()).containsExactly(0.1, 0.2, 0.3);
        assertThat(snapshot.fluid().get(0).velocity()).containsExactly(4, 5, 6);
        Files.writeString(file, "time,kind,mass,x,y,z,vx,vy,vz,density\n1.5,fluid,1,x\n");
        assertThatThrownBy(() -> Snapshot.read(file)).isInstanceOf(InvalidInputException.class)
                .hasMessageContaining("line 2");
    }
}
