package io.natator.stream;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.Json;
import java.io.ByteArrayOutputStream;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.charset.StandardCharsets;

/** Makes streams as the simulator would write them, and such as it never would. */
public final class StreamBytes {

    /** Particles of {@link #scene()}: four of water, and a body of two slices of two. */
    public static final int PARTICLES = 8;
    /** Actuators of {@link #scene()}. */
    public static final int ACTUATORS = 1;

    private final ByteArrayOutputStream bytes = new ByteArrayOutputStream();

    /** A scene of {@value #PARTICLES} particles, the last of which is held in place. */
    public static ObjectNode scene() {
        String json = """
                {"protocol":2,"program":{"version":"0.1.0","instructionSet":"portable"},"number":1,"restarted":true,
                 "scene":"test/pool","overrides":null,"gait":{"frequency":1,"amplitude":[0.5],"phase":[0]},
                 "scheme":"flex","precision":"float","definition":{"name":"pool"},"timeStep":0.0125,"duration":4,
                 "radius":0.15,"solidRestDistance":0.15,"fluidRestDistance":0.1,"planes":[[0,1,0,0]],
                 "fields":["position","velocity","density","force"],"particles":8,"mass":[2,2,1,1,1,1,1,null],
                 "fluid":[0,4],"body":[4,5,6,7],"slices":[[4,5],[6,7]],"bodyLength":0.075,"clusters":[[4,5,6,7]],
                 "joints":[0,1],"actuators":1,
                 "muscles":[{"a":4,"b":6,"actuator":0,"lateral":-1,"restLength":0.075}]}""";
        try {
            return Json.parse(json, ObjectNode.class);
        } catch (JsonProcessingException e) {
            throw new IllegalStateException(e);
        }
    }

    /** A message with this body. */
    public StreamBytes message(String letters, byte[] body) {
        bytes.writeBytes(letters.getBytes(StandardCharsets.ISO_8859_1));
        bytes.writeBytes(ByteBuffer.allocate(4).order(ByteOrder.LITTLE_ENDIAN).putInt(body.length).array());
        bytes.writeBytes(body);
        return this;
    }

    /** A message of JSON, filled up with spaces. */
    public StreamBytes json(String letters, Object value) {
        byte[] text = (value instanceof String line ? line : Json.line(value)).getBytes(StandardCharsets.UTF_8);
        ByteBuffer body = ByteBuffer.allocate((text.length + 3) / 4 * 4).put(text);
        while (body.hasRemaining()) {
            body.put((byte) ' ');
        }
        return message(letters, body.array());
    }

    /** A frame of {@link #scene()}: every number tells its frame, its field and its place. */
    public StreamBytes frame(int number, int frame) {
        return message("FRAM", frameBody(number, frame, 10 * PARTICLES + ACTUATORS));
    }

    /** A frame's body with so many floats behind its head. */
    public static byte[] frameBody(int number, int frame, int floats) {
        ByteBuffer body = ByteBuffer.allocate(StreamFrame.HEAD_BYTES + 4 * floats).order(ByteOrder.LITTLE_ENDIAN);
        body.putInt(number).putInt(frame).putInt(3).putInt(2);
        body.putDouble(frame * 0.0125).putDouble(0.002).putDouble(-0.25);
        for (int i = 1; i <= 7; i++) {
            body.putFloat(i / 8f);
        }
        body.putInt(0);
        for (int i = 0; i < floats; i++) {
            body.putFloat(1000 * frame + i + 0.5f);
        }
        return body.array();
    }

    /** Bytes that belong to no message. */
    public StreamBytes raw(byte... more) {
        bytes.writeBytes(more);
        return this;
    }

    /** All of it. */
    public byte[] toBytes() {
        return bytes.toByteArray();
    }
}
