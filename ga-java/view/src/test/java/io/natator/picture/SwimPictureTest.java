package io.natator.picture;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.Json;
import io.natator.stream.StreamBytes;
import io.natator.stream.StreamFrame;
import io.natator.stream.StreamScene;
import java.awt.Color;
import java.awt.image.BufferedImage;
import java.util.ArrayList;
import java.util.List;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.EnumSource;

/** A body of two slices, in vacuum and in a tank that is filled with water: what is where the projection says. */
class SwimPictureTest {

    private static final float[][] BODY = {{1.3f, 0.45f, 0.5f}, {1.3f, 0.55f, 0.5f}, {1.1f, 0.45f, 0.5f}, {1.1f, 0.55f, 0.5f}};
    private static final int WATER_X = 20;
    private static final int WATER_YZ = 8;

    private final List<float[]> places = new ArrayList<>();

    /** The body behind so much water. */
    private StreamScene scene(boolean tank) throws JsonProcessingException {
        for (int i = 0; tank && i < WATER_X * WATER_YZ * WATER_YZ; i++) {
            places.add(new float[] {0.05f + 0.1f * (i % WATER_X), 0.05f + 0.1f * (i / WATER_X % WATER_YZ),
                0.05f + 0.1f * (i / WATER_X / WATER_YZ)});
        }
        int water = places.size();
        places.addAll(List.of(BODY));
        ObjectNode scene = StreamBytes.scene();
        scene.put("particles", places.size()).put("bodyLength", 0.3);
        scene.putArray("fluid").add(0).add(water);
        ArrayNode mass = scene.putArray("mass");
        places.forEach(place -> mass.add(1));
        scene.putArray("muscles");
        ArrayNode body = scene.putArray("body");
        ArrayNode slices = scene.putArray("slices");
        scene.putArray("clusters");
        for (int i = 0; i < BODY.length; i++) {
            body.add(water + i);
            (i % 2 == 0 ? slices.addArray() : (ArrayNode) slices.get(i / 2)).add(water + i);
        }
        ArrayNode planes = scene.putArray("planes");
        if (tank) {
            for (double[] plane : new double[][] {{1, 0, 0, 0}, {-1, 0, 0, 2}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, -1, 0.8}}) {
                ArrayNode numbers = planes.addArray();
                for (double number : plane) {
                    numbers.add(number);
                }
            }
        }
        return Json.parse(scene.toString(), StreamScene.class);
    }

    private StreamFrame frame() {
        float[] position = new float[3 * places.size()];
        for (int i = 0; i < position.length; i++) {
            position[i] = places.get(i / 3)[i % 3];
        }
        return new StreamFrame(1, 0, 0, false, false, 1.25, 0, 0, new float[3], 0, 0, 0, 0, new float[1], position,
                new float[0], new float[0]);
    }

    private static Color at(BufferedImage picture, Projection projection, double x, double y, double z) {
        return new Color(picture.getRGB((int) Math.round(projection.x(x, y, z)), (int) Math.round(projection.y(x, y, z))));
    }

    @ParameterizedTest
    @EnumSource(From.class)
    void aBodyInVacuumIsOnWhite(From from) throws JsonProcessingException {
        StreamScene scene = scene(false);
        BufferedImage picture = SwimPicture.draw(scene, frame(), new PictureOptions(from, 400, 300, true));
        Projection projection = Framing.of(scene, frame()).projection(from, 400, 300);

        assertThat(picture.getWidth()).isEqualTo(400);
        assertThat(picture.getHeight()).isEqualTo(300);
        for (float[] place : BODY) {
            Color seen = at(picture, projection, place[0], place[1], place[2]);
            assertThat(seen.getRed()).as("warm at " + place[0]).isGreaterThan(seen.getBlue() + 60);
        }
        assertThat(picture.getRGB(2, 2)).isEqualTo(Color.WHITE.getRGB());
    }

    @Test
    void waterVeilsWhatIsBehindItAndEndsAtTheWalls() throws JsonProcessingException {
        StreamScene scene = scene(true);
        BufferedImage picture = SwimPicture.draw(scene, frame(), new PictureOptions(From.SIDE, 500, 0, true));
        BufferedImage without = SwimPicture.draw(scene, frame(), new PictureOptions(From.SIDE, 500, 0, false));
        Projection projection = Framing.of(scene, frame()).projection(From.SIDE, 500, picture.getHeight());

        assertThat(without.getHeight()).isEqualTo(picture.getHeight());
        Color water = at(picture, projection, 1.6, 0.3, 0.5);
        assertThat(water.getBlue()).isGreaterThan(water.getRed() + 40);
        assertThat(at(without, projection, 1.6, 0.3, 0.5)).isEqualTo(Color.WHITE);
        assertThat(at(picture, projection, 1.6, -0.04, 0.5)).isEqualTo(Color.WHITE);
        Color veiled = at(picture, projection, 1.3, 0.45, 0.5);
        Color bare = at(without, projection, 1.3, 0.45, 0.5);
        assertThat(veiled.getRed()).isLessThan(bare.getRed()).isGreaterThan(veiled.getBlue() + 40);
    }

    /** A long tank is cut off some way from the swimmer; one not much longer than it is shown to its ends. */
    @Test
    void aShortTankIsShownWhole() throws JsonProcessingException {
        StreamScene small = scene(true);
        ObjectNode json = Json.parse(Json.line(small), ObjectNode.class);
        StreamScene large = Json.parse(json.put("bodyLength", 1.2).toString(), StreamScene.class);

        assertThat(Framing.of(small, frame()).shown().size(0)).isCloseTo(0.2 + 2 * 0.6 * 0.3, within(1e-6));
        assertThat(Framing.of(large, frame()).shown()).usingRecursiveComparison().isEqualTo(Framing.of(large, frame()).tank());
    }

    /** Edges along x, seen from above, are where a tank that is periodic along z is cut off. */
    @Test
    void aPeriodicTankHasNoEdgesAtItsEnds() throws JsonProcessingException {
        StreamScene walled = scene(true);
        ObjectNode json = Json.parse(Json.line(walled), ObjectNode.class);
        json.putObject("periodic").putArray("z").add(0).add(0.8);
        StreamScene periodic = Json.parse(json.toString(), StreamScene.class);
        PictureOptions options = new PictureOptions(From.TOP, 500, 0, false);
        BufferedImage with = SwimPicture.draw(walled, frame(), options);
        BufferedImage without = SwimPicture.draw(periodic, frame(), options);
        Projection projection = Framing.of(walled, frame()).projection(From.TOP, 500, with.getHeight());

        assertThat(at(with, projection, 1.2, 0, 0.8).getGreen()).isLessThan(at(without, projection, 1.2, 0, 0.8).getGreen() - 10);
        assertThat(at(without, projection, 1.2, 0.5, 0.45)).isEqualTo(at(with, projection, 1.2, 0.5, 0.45));
    }

    @Test
    void aScaleIsAsLongAsItSays() throws JsonProcessingException {
        StreamScene scene = scene(true);
        BufferedImage picture = SwimPicture.draw(scene, frame(), new PictureOptions(From.SIDE, 800, 0, true));
        double pixels = Framing.of(scene, frame()).projection(From.SIDE, 800, picture.getHeight()).scale();

        int longest = 0;
        for (int row = picture.getHeight() - 40; row < picture.getHeight(); row++) {
            int dark = 0;
            for (int column = 0; column < 300; column++) {
                dark = new Color(picture.getRGB(column, row)).getGreen() < 80 ? dark + 1 : 0;
                longest = Math.max(longest, dark);
            }
        }
        assertThat(longest / pixels).isBetween(0.98 * 0.2, 1.02 * 0.2);
    }
}
