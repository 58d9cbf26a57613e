package io.natator.view;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.Json;
import io.natator.kinematics.FishMode;
import io.natator.stream.StreamBytes;
import io.natator.stream.StreamFrame;
import io.natator.stream.StreamScene;
import java.util.Arrays;
import org.junit.jupiter.api.Test;

/** Motion of a body whose every slice follows the formula of a real fish, scaled. */
class LiveKinematicsTest {

    private static final double LENGTH = 1.2;
    private static final int SLICES = 25;
    private static final int PER_SLICE = 4;
    private static final double STEP = 1.0 / 60;
    private static final double FREQUENCY = 1.25;
    private static final double SCALE = 0.5;

    private final LiveKinematics motion = new LiveKinematics();

    private static StreamScene scene(double frequency, double amplitude, boolean restarted) throws JsonProcessingException {
        ObjectNode json = StreamBytes.scene();
        json.put("restarted", restarted).put("timeStep", STEP).put("particles", SLICES * PER_SLICE);
        json.put("bodyLength", LENGTH);
        json.set("gait", Json.parse("{\"frequency\":" + frequency + ",\"amplitude\":[" + amplitude + "],\"phase\":[0]}",
                ObjectNode.class));
        ArrayNode body = json.putArray("body");
        ArrayNode slices = json.putArray("slices");
        for (int slice = 0; slice < SLICES; slice++) {
            ArrayNode one = slices.addArray();
            for (int i = 0; i < PER_SLICE; i++) {
                body.add(PER_SLICE * slice + i);
                one.add(PER_SLICE * slice + i);
            }
        }
        return Json.parse(json.toString(), StreamScene.class);
    }

    /** The body at a frame: it swims along x with its head in front, at half the fish's amplitude. */
    private static StreamFrame frame(int frame) {
        return frame(frame, 1);
    }

    /** The same with a wave that goes to the tail (1), or from there to the head (−1). */
    private static StreamFrame frame(int frame, int way) {
        double time = frame * STEP;
        float[] position = new float[3 * SLICES * PER_SLICE];
        for (int slice = 0; slice < SLICES; slice++) {
            double x = LENGTH * slice / (SLICES - 1);
            double z = SCALE * FishMode.ANGUILLIFORM.lateral(x, way * time, LENGTH, FREQUENCY);
            for (int i = 0; i < PER_SLICE; i++) {
                int at = 3 * (PER_SLICE * slice + i);
                position[at] = (float) (2 + 0.3 * time - x);
                position[at + 1] = 0.3f + 0.05f * (i % 2);
                position[at + 2] = (float) (0.7 + z + 0.05 * (i / 2 - 0.5));
            }
        }
        return new StreamFrame(1, frame, 0, true, false, time, 0.001, 0, new float[3], 0, 0, 0, 0, new float[1],
                position, new float[0], new float[0]);
    }

    @Test
    void aScaledFishIsFoundAgain() throws JsonProcessingException {
        motion.begin(scene(FREQUENCY, 0.8, true));
        for (int i = 0; i < 150; i++) {
            motion.add(frame(i));
        }

        LiveKinematics.Analysis analysis = motion.lastBeats().analyse();

        assertThat(analysis.frequency()).isEqualTo(FREQUENCY);
        assertThat(analysis.frames()).isEqualTo(48);
        LiveKinematics.Mode eel = analysis.modes().get(0);
        assertThat(eel.name()).isEqualTo("anguilliform");
        assertThat(eel.alpha()).isCloseTo(1 / SCALE, within(0.1));
        assertThat(eel.e()).isLessThan(0.06);
        assertThat(analysis.nearest()).isEqualTo("anguilliform");
        double[] tail = analysis.envelope().get(LiveKinematics.PLACES - 1);
        assertThat(tail[0]).isCloseTo(1, within(0.03));
        assertThat(tail[1]).isCloseTo(SCALE * 0.1, within(0.015));
        double[] fishTail = eel.envelope().get(LiveKinematics.PLACES - 1);
        assertThat(fishTail).containsExactly(1, 0.1);
    }

    @Test
    void aWaveFromTheTailIsLikeNoFish() throws JsonProcessingException {
        motion.begin(scene(FREQUENCY, 0.8, true));
        for (int i = 0; i < 150; i++) {
            motion.add(frame(i, -1));
        }

        LiveKinematics.Analysis analysis = motion.lastBeats().analyse();

        assertThat(analysis.modes()).allSatisfy(mode -> assertThat(mode.e()).isGreaterThan(0.25));
        assertThat(analysis.nearest()).isNull();
    }

    /** Two whole beats of 48 frames fit into two seconds; with fewer frames it is one, and with less than one none. */
    @Test
    void onlyWholeBeatsCount() throws JsonProcessingException {
        motion.begin(scene(FREQUENCY, 0.8, true));
        for (int i = 0; i < 47; i++) {
            motion.add(frame(i));
        }
        assertThat(motion.lastBeats()).isNull();

        for (int i = 47; i < 90; i++) {
            motion.add(frame(i));
        }
        double[] times = motion.lastBeats().spine().times();
        assertThat(times).hasSize(48);
        assertThat(times[0]).isCloseTo(42 * STEP, within(1e-9));
        for (int i = 90; i < 300; i++) {
            motion.add(frame(i));
        }
        times = motion.lastBeats().spine().times();
        assertThat(times).hasSize(48);
        assertThat(times[0]).isCloseTo(204 * STEP, within(1e-9));
    }

    @Test
    void missingFramesDoNotMatter() throws JsonProcessingException {
        motion.begin(scene(FREQUENCY, 0.8, true));
        for (int i = 0; i < 300; i += 5) {
            motion.add(frame(i));
        }

        LiveKinematics.Analysis analysis = motion.lastBeats().analyse();

        assertThat(analysis.frames()).isBetween(18, 20);
        assertThat(analysis.modes().get(0).alpha()).isCloseTo(1 / SCALE, within(0.15));
    }

    @Test
    void anotherGaitAndANewStartBeginAnew() throws JsonProcessingException {
        motion.begin(scene(FREQUENCY, 0.8, true));
        for (int i = 0; i < 100; i++) {
            motion.add(frame(i));
        }
        motion.add(frame(0));
        assertThat(motion.lastBeats()).isNull();

        for (int i = 1; i < 100; i++) {
            motion.add(frame(i));
        }
        assertThat(motion.lastBeats()).isNotNull();
        motion.begin(scene(2, 0.8, false));
        assertThat(motion.lastBeats()).isNull();
    }

    @Test
    void ofABodyAtRestNothingIsSaid() throws JsonProcessingException {
        motion.begin(scene(FREQUENCY, 0, true));
        for (int i = 0; i < 100; i++) {
            motion.add(frame(i));
        }
        assertThat(motion.lastBeats()).isNull();
    }

    @Test
    void numbersThatAreNoneAreLeftOut() throws JsonProcessingException {
        motion.begin(scene(FREQUENCY, 0.8, true));
        for (int i = 0; i < 100; i++) {
            motion.add(frame(i));
        }
        int before = motion.lastBeats().spine().frames();
        StreamFrame broken = frame(100);
        Arrays.fill(broken.position(), Float.NaN);
        motion.add(broken);
        assertThat(motion.lastBeats().spine().frames()).isEqualTo(before);
    }
}
