package io.natator.stream;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.NullNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.base.Numbers;
import io.natator.config.Json;
import java.io.IOException;
import java.io.InputStream;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.charset.StandardCharsets;
import java.util.Locale;

/**
 * Reads the messages of one stream, each in one piece and no further than the protocol allows, so that a broken program
 * costs a clear error and no memory. To be used by one thread.
 */
public final class StreamReader {

    /** A scene of 100 000 particles is some 3 MB. */
    static final int MAX_TEXT_BYTES = 256 << 20;
    /** Water of 16 million cells: more than any page shows. */
    static final int MAX_WATER_BYTES = 256 << 20;
    private static final int CELL_BYTES = 16;
    /** Behind those, where the head says so. */
    private static final int PRESSURE_BYTES = 4;
    private static final int HEAD_BYTES = 8;
    private static final int LETTERS = 4;

    private final InputStream in;
    private final byte[] head = new byte[HEAD_BYTES];
    /** All that is known of the scene: the last {@code SCEN}, over those before it that it goes on from. */
    private ObjectNode sceneBody;
    private StreamScene scene;

    /** A reader that takes from {@code in} no byte more than the messages that it returns. */
    public StreamReader(InputStream in) {
        this.in = in;
    }

    /**
     * Waits for the next message.
     *
     * @return the message, or null at the end of the stream
     * @throws StreamException if the stream ends within a message, or the message breaks the protocol; nothing can be
     *                         read after that
     * @throws IOException     if the stream cannot be read
     */
    public StreamMessage next() throws IOException {
        int count = in.readNBytes(head, 0, HEAD_BYTES);
        if (count == 0) {
            return null;
        }
        if (count < HEAD_BYTES) {
            throw StreamException
                    .atEnd("stream ended " + Numbers.count(count, "byte") + " into the 8-byte head of a message");
        }
        String letters = new String(head, 0, LETTERS, StandardCharsets.ISO_8859_1);
        long length = Integer.toUnsignedLong(ByteBuffer.wrap(head).order(ByteOrder.LITTLE_ENDIAN).getInt(LETTERS));
        return switch (letters) {
            case "SCEN" -> scene(text(letters, length));
            case "FRAM" -> frame(length);
            case "WATR" -> water(length);
            case "ANSW" -> answer(text(letters, length));
            case "STOP" -> stop(text(letters, length));
            default -> throw new StreamException("message begins with " + shown(letters)
                    + "; expected SCEN, FRAM, WATR, ANSW or STOP");
        };
    }

    private StreamMessage scene(String json) throws StreamException {
        ObjectNode body = object("SCEN", json);
        if (sceneBody != null && body.path("restarted").isBoolean() && !body.get("restarted").booleanValue()) {
            sceneBody.setAll(body);
        } else {
            sceneBody = body;
        }
        scene = StreamScene.of(sceneBody);
        return new StreamMessage.Scene(scene, json);
    }

    private StreamMessage frame(long length) throws IOException {
        if (scene == null) {
            throw new StreamException("FRAM before the first SCEN");
        }
        if (length != scene.frameBytes()) {
            throw new StreamException("FRAM of " + length + " bytes; expected " + scene.frameBytes() + " for "
                    + Numbers.count(scene.particles(), "particle") + " and "
                    + Numbers.count(scene.actuators(), "actuator"));
        }
        byte[] bytes = new byte[(int) length];
        whole("FRAM", in.readNBytes(bytes, 0, bytes.length), length);
        ByteBuffer body = ByteBuffer.wrap(bytes).asReadOnlyBuffer().order(ByteOrder.LITTLE_ENDIAN);
        long number = Integer.toUnsignedLong(body.getInt(0));
        if (number != scene.number()) {
            throw new StreamException("FRAM of scene " + number + " after SCEN " + scene.number());
        }
        return new StreamMessage.Frame(scene, body);
    }

    private StreamMessage water(long length) throws IOException {
        if (length < StreamMessage.Water.HEAD_BYTES || length > MAX_WATER_BYTES) {
            throw new StreamException(
                    "WATR of " + length + " bytes; expected " + StreamMessage.Water.HEAD_BYTES + " to "
                            + MAX_WATER_BYTES);
        }
        byte[] bytes = in.readNBytes((int) length);
        whole("WATR", bytes.length, length);
        ByteBuffer body = ByteBuffer.wrap(bytes).asReadOnlyBuffer().order(ByteOrder.LITTLE_ENDIAN);
        int ofCell = CELL_BYTES + (body.getInt(20) == 1 ? PRESSURE_BYTES : 0);
        double expected = StreamMessage.Water.HEAD_BYTES + ofCell * (double) Integer.toUnsignedLong(body.getInt(8))
                * Integer.toUnsignedLong(body.getInt(12)) * Integer.toUnsignedLong(body.getInt(16));
        if (length != expected) {
            throw new StreamException(
                    String.format(Locale.ROOT, "WATR of %d bytes; expected %.0f for its cells", length,
                            expected));
        }
        return new StreamMessage.Water(body);
    }

    private static StreamMessage answer(String json) throws StreamException {
        JsonNode answer = object("ANSW", json);
        boolean ok = answer.path("ok").asBoolean(false);
        if (ok == answer.path("error").isTextual()) {
            throw new StreamException("ANSW: expected either ok or an error, found " + shown(json));
        }
        JsonNode id = answer.path("id");
        return new StreamMessage.Answer(id.isMissingNode() ? NullNode.getInstance() : id,
                ok ? null : answer.get("error").textValue(), json);
    }

    private static StreamMessage stop(String json) throws StreamException {
        JsonNode stop = object("STOP", json);
        if (!stop.path("reason").isTextual()) {
            throw new StreamException("STOP: expected a reason, found " + shown(json));
        }
        return new StreamMessage.Stop(stop.get("reason").textValue(), json);
    }

    private static ObjectNode object(String letters, String json) throws StreamException {
        try {
            if (Json.parse(json, JsonNode.class) instanceof ObjectNode object) {
                return object;
            }
        } catch (JsonProcessingException e) {
            throw new StreamException(letters + ": " + Json.reason(e), e);
        }
        throw new StreamException(letters + ": expected a JSON object, found " + shown(json));
    }

    /** Memory grows with what arrives, not with what was announced. */
    private String text(String letters, long length) throws IOException {
        if (length > MAX_TEXT_BYTES || length % Integer.BYTES != 0) {
            throw new StreamException(letters + " of " + length + " bytes; expected a multiple of 4 up to "
                    + MAX_TEXT_BYTES);
        }
        byte[] bytes = in.readNBytes((int) length);
        whole(letters, bytes.length, length);
        return new String(bytes, StandardCharsets.UTF_8).strip();
    }

    private static void whole(String letters, int read, long length) throws StreamException {
        if (read < length) {
            throw StreamException.atEnd("stream ended after " + read + " of the " + length + " bytes of a " + letters);
        }
    }

    private static String shown(String text) {
        String clean = text.replaceAll("[\\p{Cc}\\p{Cs}\\u2028\\u2029]", "?");
        return '"' + (clean.length() > 80 ? clean.substring(0, 80) + "…" : clean) + '"';
    }
}
