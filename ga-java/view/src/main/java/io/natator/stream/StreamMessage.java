package io.natator.stream;

import com.fasterxml.jackson.databind.JsonNode;
import java.nio.ByteBuffer;

/** What the simulator says. */
public sealed interface StreamMessage {

    /**
     * {@code SCEN}: what the frames after it are about.
     *
     * @param scene its content
     * @param json  as the simulator wrote it, one line: only what has changed, if the scene goes on
     */
    record Scene(StreamScene scene, String json) implements StreamMessage {
    }

    /**
     * {@code FRAM}: one frame.
     *
     * @param scene the scene that it belongs to
     * @param body  as the simulator wrote it, from {@code number} on, little-endian; read-only
     */
    record Frame(StreamScene scene, ByteBuffer body) implements StreamMessage {

        /** The numbers of this frame. */
        public StreamFrame decode() {
            return StreamFrame.decode(scene, body);
        }
    }

    /**
     * {@code WATR}: the water on a grid.
     *
     * @param body as the simulator wrote it, from {@code number} on, little-endian; read-only
     */
    record Water(ByteBuffer body) implements StreamMessage {

        /** Bytes of a body before the velocities of its cells. */
        public static final int HEAD_BYTES = 64;
    }

    /**
     * {@code ANSW}: the answer to one command.
     *
     * @param id    the command's; a null node without one
     * @param error why it was refused, one line; null if it was carried out
     * @param json  the whole answer as the simulator wrote it, one line
     */
    record Answer(JsonNode id, String error, String json) implements StreamMessage {

        /** Whether the command was carried out. */
        public boolean ok() {
            return error == null;
        }
    }

    /**
     * {@code STOP}: the simulation has stopped by itself.
     *
     * @param reason {@code until} or {@code unstable}
     * @param json   the whole message as the simulator wrote it, one line, with particle, stage, time and law of what became unstable
     */
    record Stop(String reason, String json) implements StreamMessage {

        /** Whether the wanted time is over; the program ends. */
        public boolean isEnd() {
            return reason.equals("until");
        }
    }
}
