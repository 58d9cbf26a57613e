package io.natator.export;

import static org.assertj.core.api.Assertions.assertThat;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.stream.StreamBytes;
import io.natator.stream.StreamMessage;
import io.natator.stream.StreamReader;
import io.natator.stream.StreamScene;
import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.util.Arrays;
import java.util.HashMap;
import java.util.Map;
import org.assertj.core.data.Offset;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

class BodySurfaceTest {

    private static final float SPACING = 0.075f;

    private float[] position;

    /** A body of slices from the head on, each around the same axis: width x height, or 2-4-4-2, the rows from below. */
    private StreamScene body(String... sizes) throws IOException {
        ObjectNode scene = StreamBytes.scene();
        ArrayNode slices = scene.putArray("slices");
        ArrayNode body = scene.putArray("body");
        float[] places = new float[3000];
        int particle = 0;
        for (int i = 0; i < sizes.length; i++) {
            int[] rows = rows(sizes[i]);
            ArrayNode slice = slices.addArray();
            for (int y = 0; y < rows.length; y++) {
                for (int z = 0; z < rows[y]; z++) {
                    places[3 * particle] = -i * SPACING;
                    places[3 * particle + 1] = (y - (rows.length - 1) / 2f) * SPACING;
                    places[3 * particle + 2] = (z - (rows[y] - 1) / 2f) * SPACING;
                    body.add(particle);
                    slice.add(particle++);
                }
            }
        }
        position = places;
        scene.put("particles", particle);
        ArrayNode mass = scene.putArray("mass");
        for (int i = 0; i < particle; i++) {
            mass.add(1);
        }
        scene.putArray("fluid").add(0).add(0);
        scene.putArray("clusters");
        scene.putArray("joints");
        scene.putArray("muscles");
        StreamReader reader = new StreamReader(new ByteArrayInputStream(
                new StreamBytes().json("SCEN", scene).toBytes()));
        return ((StreamMessage.Scene) reader.next()).scene();
    }

    private static int[] rows(String size) {
        if (!size.contains("x")) {
            return Arrays.stream(size.split("-")).mapToInt(Integer::parseInt).toArray();
        }
        int[] rows = new int[Integer.parseInt(size.split("x")[1])];
        Arrays.fill(rows, Integer.parseInt(size.split("x")[0]));
        return rows;
    }

    private int[] corners(StreamScene scene) {
        return BodySurface.of(scene, position).corners(ParticleSet.of(scene, false));
    }

    /** By Gauss: positive only if the triangles are seen counter-clockwise from outside. */
    private double volume(int[] corners) {
        double sum = 0;
        for (int i = 0; i < corners.length; i += 3) {
            int a = 3 * corners[i];
            int b = 3 * corners[i + 1];
            int c = 3 * corners[i + 2];
            sum += position[a] * (position[b + 1] * position[c + 2] - position[b + 2] * position[c + 1])
                    + position[a + 1] * (position[b + 2] * position[c] - position[b] * position[c + 2])
                    + position[a + 2] * (position[b] * position[c + 1] - position[b + 1] * position[c]);
        }
        return sum / 6;
    }

    @ParameterizedTest
    @CsvSource({"3x5 3x5 3x5, 16", "2x6 2x6, 5", "2x2 2x2 2x2 2x2, 3", "2-4-4-2 2-4-4-2, 7", "1-3-5-3-1 1-3-5-3-1, 8",
        "1-5-1 1-5-1 1-5-1, 8"})
    void aPrismIsEnclosedExactly(String slices, double cells) throws IOException {
        StreamScene scene = body(slices.split(" "));

        assertThat(volume(corners(scene))).isCloseTo(cells * Math.pow(SPACING, 3), Offset.offset(1e-7));
    }

    /** Every edge is gone along once in each direction: nothing is open. Flat slices and points are shapes too. */
    @ParameterizedTest
    @CsvSource({"1x3 2x4 3x5 3x6 2x5 1x3", "4x4 1x1", "1x1 3x2 1x2", "1x4 1x4", "5x1 5x1 2x1", "2x2 3x3 5x5 4x4",
        "2x2 2-4-4-2 1-3-5-5-3-1 3x4 1x6", "1-3-1 1-5-1"})
    void everyShapeIsClosed(String slices) throws IOException {
        int[] corners = corners(body(slices.split(" ")));

        assertThat(corners).isNotEmpty();
        Map<Long, Integer> open = new HashMap<>();
        for (int i = 0; i < corners.length; i++) {
            long from = corners[i];
            long to = corners[i % 3 == 2 ? i - 2 : i + 1];
            open.merge(Math.min(from, to) << 32 | Math.max(from, to), from < to ? 1 : -1, Integer::sum);
        }
        assertThat(open.values()).containsOnly(0);
        assertThat(volume(corners)).isGreaterThanOrEqualTo(0);
    }

    /** A settled start is not quite the grid that was built. */
    @Test
    void smallShiftsDoNotMatter() throws IOException {
        StreamScene scene = body("3x5", "3x5");
        int[] before = corners(scene);
        for (int i = 0; i < position.length; i++) {
            position[i] += 0.004f * (i % 3 - 1) * (i % 7 - 3) / 3f;
        }
        assertThat(corners(scene)).isEqualTo(before);
    }

    @Test
    void slicesThatAreNoGridsHaveNoSurface() throws IOException {
        StreamScene scene = body("3x5", "3x5");
        position[3 * 14 + 1] += 0.06f;

        assertThat(corners(scene)).isEmpty();
        for (String slice : new String[] {"2-3-2", "4-2-4", "2-4", "2-4-2-2"}) {
            assertThat(corners(body("3x5", slice))).as(slice).isEmpty();
        }
    }

    @Test
    void oneSliceHasNoSurface() throws IOException {
        assertThat(corners(body("3x5"))).isEmpty();
    }
}
