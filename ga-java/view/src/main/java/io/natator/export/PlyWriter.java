package io.natator.export;

import io.natator.stream.StreamFrame;
import java.io.BufferedOutputStream;
import java.io.IOException;
import java.io.OutputStream;
import java.nio.ByteBuffer;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Locale;

/** For Blender and others: a binary PLY file for each frame, a vertex for each particle. */
final class PlyWriter implements FrameWriter {

    private final ExportContext swim;
    private final Path folder;
    private final ByteBuffer rows;

    PlyWriter(ExportContext swim, Path folder) {
        this.swim = swim;
        this.folder = folder;
        int floats = 3 + (swim.hasVelocity() ? 3 : 0) + (swim.hasDensity() ? 1 : 0) + 1;
        this.rows = LittleEndian.buffer((long) swim.shown().size() * (floats * Float.BYTES + 1 + 2 * Integer.BYTES));
    }

    @Override
    public void frame(StreamFrame frame) throws IOException {
        ParticleSet shown = swim.shown();
        rows.clear();
        for (int i = 0; i < shown.size(); i++) {
            int particle = shown.index(i);
            put(frame.position(), 3, particle);
            put(frame.velocity(), swim.hasVelocity() ? 3 : 0, particle);
            put(frame.density(), swim.hasDensity() ? 1 : 0, particle);
            rows.putFloat(shown.mass(i)).put((byte) shown.kind(i).ordinal()).putInt(shown.cluster(i)).putInt(shown.creature(i));
        }
        Path file = folder.resolve(String.format(Locale.ROOT, "swim_%06d.ply", frame.frame()));
        try (OutputStream out = new BufferedOutputStream(Files.newOutputStream(file))) {
            out.write(head(frame).getBytes(StandardCharsets.US_ASCII));
            out.write(rows.array(), 0, rows.position());
        }
        if (swim.hasWaterSurface()) {
            writeSurface(frame);
        }
    }

    /** A mesh in a file of its own. */
    private void writeSurface(StreamFrame frame) throws IOException {
        WaterSurface.Mesh mesh = swim.waterSurface().of(frame);
        Path surfaces = Files.createDirectories(folder.resolve("water-surface"));
        ByteBuffer faces = LittleEndian.buffer((long) mesh.triangleCount() * (1 + 3 * Integer.BYTES));
        for (int i = 0; i < mesh.triangles().length; i += 3) {
            faces.put((byte) 3).putInt(mesh.triangles()[i]).putInt(mesh.triangles()[i + 1])
                    .putInt(mesh.triangles()[i + 2]);
        }
        Path file = surfaces.resolve(String.format(Locale.ROOT, "water-surface_%06d.ply", frame.frame()));
        try (OutputStream out = new BufferedOutputStream(Files.newOutputStream(file))) {
            out.write((headLines(frame, mesh.vertexCount()) + "element face " + mesh.triangleCount()
                    + "\nproperty list uchar int vertex_indices\nend_header\n").getBytes(StandardCharsets.US_ASCII));
            out.write(LittleEndian.floats(mesh.places()).array());
            out.write(faces.array());
        }
    }

    private String headLines(StreamFrame frame, int vertices) {
        return "ply\nformat binary_little_endian 1.0\ncomment " + swim.title() + ", frame " + frame.frame() + ", time "
                + frame.time() + " s\nelement vertex " + vertices + "\n"
                + "property float x\nproperty float y\nproperty float z\n";
    }

    private void put(float[] values, int components, int particle) {
        for (int i = particle * components; i < (particle + 1) * components; i++) {
            rows.putFloat(values[i]);
        }
    }

    private String head(StreamFrame frame) {
        return headLines(frame, swim.shown().size())
                + (swim.hasVelocity() ? "property float vx\nproperty float vy\nproperty float vz\n" : "")
                + (swim.hasDensity() ? "property float density\n" : "")
                + "property float mass\nproperty uchar kind\nproperty int cluster\nproperty int creature\nend_header\n";
    }

    @Override
    public void finish() {
        // Every file is whole already.
    }

    @Override
    public void close() {
        // Nothing stays open between frames.
    }
}
