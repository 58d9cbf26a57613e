package io.natator.cli;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.config.InvalidInputException;
import io.natator.config.MergePatch;
import io.natator.config.Scheme;
import io.natator.picture.PictureOptions;
import io.natator.picture.SwimPicture;
import io.natator.replay.Replay;
import io.natator.replay.ReplayRecorder;
import io.natator.simulator.SceneInfo;
import io.natator.stream.StreamFrame;
import io.natator.stream.StreamOptions;
import java.awt.image.BufferedImage;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Path;
import javax.imageio.ImageIO;

/**
 * A swim at one time.
 *
 * @param picture of it
 * @param time    in seconds
 */
record DrawnSwim(BufferedImage picture, double time) {

    /**
     * Simulates a swim up to a time and draws it.
     *
     * @param changes to the scene, or null
     * @param scheme  or null for the swimmer's own
     * @param at      seconds, or null for 1 s, the end of a shorter swim, or 0 of a body at rest
     * @throws InvalidInputException if the swim does not last so long
     */
    static DrawnSwim of(SwimSource swimmer, JsonNode changes, Scheme scheme, Double at, PictureOptions options, Path simulator)
            throws InterruptedException {
        JsonNode overrides = MergePatch.both(swimmer.overrides(), changes);
        double duration = swimmer.seconds(null, overrides, simulator);
        double step = SceneInfo.of(swimmer.scene(), overrides, simulator).timeStep();
        double time = at != null ? at : swimmer.gait() == null ? 0 : Math.min(1, duration);
        if (!(time >= 0 && time <= duration)) {
            throw new InvalidInputException("--at is " + time + "; expected a time of the swim, 0 to " + duration + " s");
        }
        int frames = (int) Math.round(time / step);
        Replay swim = new ReplayRecorder(simulator).record(swimmer.name(),
                StreamOptions.recording(swimmer.scene(), overrides, swimmer.gaitJson(), frames * step)
                        .with(scheme != null ? scheme : swimmer.scheme(), null).withEvery(Math.max(1, frames)));
        StreamFrame frame = swim.frames().get(swim.frames().size() - 1);
        return new DrawnSwim(SwimPicture.draw(swim.scene(), frame, options), frame.time());
    }

    /** The picture as a PNG file's content. */
    byte[] png() {
        ByteArrayOutputStream bytes = new ByteArrayOutputStream();
        try {
            ImageIO.write(picture, "png", bytes);
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
        return bytes.toByteArray();
    }
}
