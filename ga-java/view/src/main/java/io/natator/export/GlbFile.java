package io.natator.export;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.Json;
import java.io.BufferedOutputStream;
import java.io.ByteArrayOutputStream;
import java.io.IOException;
import java.io.OutputStream;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;

/** A file of glTF 2.0 in binary form: a JSON document and the numbers that it refers to. */
final class GlbFile {

    private static final int MAGIC = 0x46546C67;
    private static final int JSON_CHUNK = 0x4E4F534A;
    private static final int BINARY_CHUNK = 0x004E4942;
    private static final int WORD = 4;
    private static final int UNSIGNED_SHORT = 5123;
    private static final int UNSIGNED_INT = 5125;
    private static final int FLOAT = 5126;
    private static final int VERTICES = 34962;
    private static final int INDICES = 34963;

    private final ObjectNode document = JsonNodeFactory.instance.objectNode();
    private final ByteArrayOutputStream numbers = new ByteArrayOutputStream();

    /** A document without content. */
    GlbFile(String generator) {
        document.putObject("asset").put("version", "2.0").put("generator", generator);
        document.put("scene", 0);
    }

    /** One of the document's lists; it appears when it is first asked for. */
    ArrayNode list(String name) {
        return document.withArrayProperty(name);
    }

    /** Adds to a list; the place there. */
    int add(String list, ObjectNode value) {
        list(list).add(value);
        return list(list).size() - 1;
    }

    /** Numbers of each vertex; the accessor's place. */
    int vertices(String type, float... values) {
        return accessor(type, FLOAT, values.length, LittleEndian.floats(values), VERTICES);
    }

    /** Places of vertices, with their bounds, which the format asks for. */
    int places(float... values) {
        int accessor = vertices("VEC3", values);
        bound(accessor, values, 3);
        return accessor;
    }

    /** Small whole numbers of each vertex, four each. */
    int joints(short... values) {
        ByteBuffer buffer = LittleEndian.buffer((long) values.length * Short.BYTES);
        buffer.asShortBuffer().put(values);
        return accessor("VEC4", UNSIGNED_SHORT, values.length, buffer, VERTICES);
    }

    /** Corners of triangles. */
    int corners(int... values) {
        return accessor("SCALAR", UNSIGNED_INT, values.length, LittleEndian.ints(values), INDICES);
    }

    /** Numbers that are of no vertex. */
    int values(String type, float... values) {
        return accessor(type, FLOAT, values.length, LittleEndian.floats(values), 0);
    }

    /** Times of key frames, s, with their bounds. */
    int times(float... values) {
        int accessor = values("SCALAR", values);
        bound(accessor, values, 1);
        return accessor;
    }

    private void bound(int accessor, float[] values, int components) {
        ObjectNode node = (ObjectNode) list("accessors").get(accessor);
        ArrayNode low = node.putArray("min");
        ArrayNode high = node.putArray("max");
        for (int axis = 0; axis < components; axis++) {
            float least = Float.POSITIVE_INFINITY;
            float most = Float.NEGATIVE_INFINITY;
            for (int i = axis; i < values.length; i += components) {
                least = Math.min(least, values[i]);
                most = Math.max(most, values[i]);
            }
            low.add(least);
            high.add(most);
        }
    }

    private int accessor(String type, int componentType, int count, ByteBuffer values, int target) {
        int components = switch (type) {
            case "SCALAR" -> 1;
            case "VEC3" -> 3;
            case "VEC4" -> 4;
            case "MAT4" -> 16;
            default -> throw new IllegalArgumentException(type);
        };
        ObjectNode view = JsonNodeFactory.instance.objectNode().put("buffer", 0).put("byteOffset", numbers.size())
                .put("byteLength", values.capacity());
        if (target != 0) {
            view.put("target", target);
        }
        numbers.writeBytes(values.array());  // all kinds take whole words
        return add("accessors", JsonNodeFactory.instance.objectNode().put("bufferView", add("bufferViews", view))
                .put("componentType", componentType).put("count", count / components).put("type", type));
    }

    /** Writes the file. */
    void write(Path file) throws IOException {
        list("buffers").addObject().put("byteLength", numbers.size());
        byte[] json = Json.line(document).strip().getBytes(StandardCharsets.UTF_8);
        int padding = (WORD - json.length % WORD) % WORD;
        int total = 3 * WORD + 2 * WORD + json.length + padding + 2 * WORD + numbers.size();
        try (OutputStream out = new BufferedOutputStream(Files.newOutputStream(file))) {
            out.write(LittleEndian.ints(MAGIC, 2, total).array());
            out.write(LittleEndian.ints(json.length + padding, JSON_CHUNK).array());
            out.write(json);
            out.write(" ".repeat(padding).getBytes(StandardCharsets.US_ASCII));
            out.write(LittleEndian.ints(numbers.size(), BINARY_CHUNK).array());
            numbers.writeTo(out);
        }
    }
}
