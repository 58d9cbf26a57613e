package io.natator.export;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.Json;
import io.natator.stream.StreamFrame;
import io.natator.stream.StreamScene;
import java.io.BufferedOutputStream;
import java.io.Closeable;
import java.io.DataInputStream;
import java.io.EOFException;
import java.io.IOException;
import java.io.OutputStream;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.charset.StandardCharsets;
import java.util.stream.IntStream;

/**
 * The surface of the water as a closed mesh, which splashsurf makes of its particles; {@code water_surface.py} says how.
 */
final class WaterSurface implements Closeable {

    /** A package of Python, under this name on PyPI too. */
    static final String MODULE = "pysplashsurf";
    private static final int CORNERS = 3;

    private final ParticleSet water;
    private final Process process;
    private final OutputStream out;
    private final DataInputStream in;
    private StreamFrame last;
    private Mesh mesh;

    /**
     * A mesh of triangles.
     *
     * @param places    x, y, z of each vertex
     * @param triangles three vertices each, counter-clockwise seen from outside the water
     */
    record Mesh(float[] places, int[] triangles) {

        int vertexCount() {
            return places.length / CORNERS;
        }

        int triangleCount() {
            return triangles.length / CORNERS;
        }

        /** Where in {@link #triangles} each triangle ends. */
        int[] ends() {
            return IntStream.rangeClosed(1, triangleCount()).map(i -> CORNERS * i).toArray();
        }
    }

    /** The surface of a scene's water, which has particles. */
    WaterSurface(StreamScene scene, Python python) throws IOException {
        water = ParticleSet.water(scene);
        process = python.start("water_surface.py");
        out = new BufferedOutputStream(process.getOutputStream());
        in = new DataInputStream(process.getInputStream());
        ObjectNode head = JsonNodeFactory.instance.objectNode().put("spacing", scene.fluidRestDistance())
                .put("particles", water.size());
        ArrayNode planes = head.putArray("planes");
        scene.planes().forEach(plane -> plane.forEach(planes.addArray()::add));
        out.write((Json.line(head).strip() + "\n").getBytes(StandardCharsets.UTF_8));
    }

    /** The mesh in a frame; asked for the same frame again, the same. */
    Mesh of(StreamFrame frame) throws IOException {
        if (frame != last) {
            try {
                out.write(water.floats(frame.position(), CORNERS).array());
                out.flush();
                ByteBuffer counts = read(2);
                int vertices = counts.getInt();
                int triangles = counts.getInt();
                float[] places = new float[CORNERS * vertices];
                read(places.length).asFloatBuffer().get(places);
                int[] corners = new int[CORNERS * triangles];
                read(corners.length).asIntBuffer().get(corners);
                mesh = new Mesh(places, corners);
                last = frame;
            } catch (EOFException e) {
                throw new IOException("water_surface.py ended in frame " + frame.frame(), e);
            }
        }
        return mesh;
    }

    /** So many numbers of 32 bits. */
    private ByteBuffer read(int numbers) throws IOException {
        ByteBuffer buffer = ByteBuffer.allocate(Math.multiplyExact(numbers, Integer.BYTES)).order(ByteOrder.LITTLE_ENDIAN);
        in.readFully(buffer.array());
        return buffer;
    }

    @Override
    public void close() {
        process.destroyForcibly();
    }
}
