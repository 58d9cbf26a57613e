package io.natator.replay;

import io.natator.base.InvalidInputException;
import io.natator.stream.StreamException;
import io.natator.stream.StreamField;
import io.natator.stream.StreamFrame;
import io.natator.stream.StreamMessage;
import io.natator.stream.StreamOptions;
import io.natator.stream.StreamProcess;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.ByteBuffer;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;

/** Simulates a swim once and keeps its frames. */
public final class ReplayRecorder {

    /** Frames that the simulator may be ahead. */
    private static final int CREDIT = 4;
    /** Frames between two of which the water is kept. */
    private static final int WATER_EVERY = 6;
    private static final List<StreamField> FIELDS = List.of(StreamField.POSITION, StreamField.DENSITY);

    private final Path simulator;

    /** A recorder that uses this native program. */
    public ReplayRecorder(Path simulator) {
        this.simulator = simulator;
    }

    /**
     * Records a swim.
     *
     * @param title   what it is to be called
     * @param options a lossless stream with an end
     * @throws InvalidInputException if the program refuses the options
     * @throws UncheckedIOException  if the simulation fails or becomes unstable
     * @throws InterruptedException  if this virtual machine is shutting down
     */
    public Replay record(String title, StreamOptions options) throws InterruptedException {
        try (StreamProcess process = new StreamProcess(simulator, options.withFields(FIELDS).waiting())) {
            return record(title, process);
        } catch (IOException e) {
            throw new UncheckedIOException(title + " cannot be recorded: " + e.getMessage(), e);
        }
    }

    /** Frame by frame, so that it is the water of that frame which is asked for. */
    private static void step(StreamProcess process, int frame) throws StreamException {
        if (frame % WATER_EVERY == 0) {
            process.send("{\"do\":\"water\"}");
        }
        process.grant(1);
        process.send("{\"do\":\"step\"}");
    }

    private static Replay record(String title, StreamProcess process) throws IOException {
        StreamMessage.Scene scene = null;
        List<StreamFrame> frames = new ArrayList<>();
        List<ByteBuffer> waters = new ArrayList<>();
        while (true) {
            StreamMessage message = process.next();
            if (message instanceof StreamMessage.Frame frame) {
                frames.add(frame.decode());
                if (scene.scene().isPlane()) {
                    step(process, frames.size() - 1);
                } else {
                    process.grant(1);
                }
            } else if (message instanceof StreamMessage.Water water) {
                waters.add(water.body());
            } else if (message instanceof StreamMessage.Scene first && scene == null) {
                scene = first;
                process.grant(first.scene().isPlane() ? 1 : CREDIT);
                if (!first.scene().isPlane()) {
                    process.send("{\"do\":\"run\"}");
                }
            } else if (message instanceof StreamMessage.Stop stop && stop.isEnd() && !frames.isEmpty()) {
                return new Replay(title, scene.scene(), scene.json(), frames, waters, Map.of());
            } else if (!(message instanceof StreamMessage.Answer answer && answer.ok())) {
                throw new IOException(message instanceof StreamMessage.Answer refused ? refused.error()
                        : message instanceof StreamMessage.Stop stop ? "the simulation stopped: " + stop.json()
                                : message == null ? "the simulator ended without a word" : "the scene changed");
            }
        }
    }
}
