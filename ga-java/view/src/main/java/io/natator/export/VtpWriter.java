package io.natator.export;

import io.natator.stream.StreamFrame;
import io.natator.stream.StreamScene;
import java.io.BufferedWriter;
import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Locale;
import java.util.stream.IntStream;

/**
 * For ParaView: {@code swim.pvd} names the files of all times, up to four each: {@code water} and {@code body} (points
 * with arrays; the body also with its surface), {@code muscles} (lines) and {@code water-surface} (triangles).
 */
final class VtpWriter implements FrameWriter {

    private final ExportContext swim;
    private final Path folder;
    private final BufferedWriter index;
    private final Fixed water;
    private final Fixed body;
    private final ByteBuffer corners;
    private final ByteBuffer ends;
    private final ByteBuffer muscleNodes;
    private final ByteBuffer muscleEnds;
    private final ByteBuffer actuators;

    /** What is the same in every frame of a set of particles. */
    private record Fixed(ParticleSet particles, ByteBuffer mass, ByteBuffer kind, ByteBuffer cluster,
            ByteBuffer creature, ByteBuffer particle, ByteBuffer nodes, ByteBuffer ends) {

        static Fixed of(ParticleSet particles) {
            int count = particles.size();
            return new Fixed(particles, particles.masses(), particles.kinds(), particles.clusters(),
                    particles.creatures(), particles.indices(), LittleEndian.ints(IntStream.range(0, count).toArray()),
                    LittleEndian.ints(IntStream.rangeClosed(1, count).toArray()));
        }
    }

    VtpWriter(ExportContext swim, Path folder) throws IOException {
        this.swim = swim;
        this.folder = folder;
        this.water = swim.hasWater() ? Fixed.of(swim.water()) : null;
        this.body = swim.solids().size() > 0 ? Fixed.of(swim.solids()) : null;
        this.corners = LittleEndian.ints(swim.surface().corners(swim.solids()));
        this.ends = LittleEndian.ints(swim.surface().ends());
        List<StreamScene.Muscle> muscles = swim.scene().muscles();
        this.muscleNodes = LittleEndian.ints(swim.muscleEnds(swim.solids()));
        this.muscleEnds = LittleEndian.ints(IntStream.rangeClosed(1, muscles.size()).map(i -> 2 * i).toArray());
        this.actuators = LittleEndian.ints(muscles.stream().mapToInt(StreamScene.Muscle::actuator).toArray());
        this.index = Files.newBufferedWriter(folder.resolve("swim.pvd"));
        index.write("<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\""
                + " byte_order=\"LittleEndian\">\n<Collection>\n");
    }

    @Override
    public void frame(StreamFrame frame) throws IOException {
        int part = 0;
        if (water != null) {
            write(points(frame, water), frame, "water", part++);
        }
        if (body != null) {
            PolyData points = points(frame, body);
            if (swim.surface().size() > 0) {
                points.cells("Polys", corners, ends);
            }
            write(points, frame, "body", part++);
        }
        if (!swim.scene().muscles().isEmpty()) {
            write(muscles(frame), frame, "muscles", part++);
        }
        if (swim.hasWaterSurface()) {
            WaterSurface.Mesh mesh = swim.waterSurface().of(frame);
            PolyData surface = new PolyData(frame.time(), LittleEndian.floats(mesh.places()));
            surface.cells("Polys", LittleEndian.ints(mesh.triangles()), LittleEndian.ints(mesh.ends()));
            write(surface, frame, "water-surface", part);
        }
    }

    private PolyData points(StreamFrame frame, Fixed fixed) {
        PolyData points = new PolyData(frame.time(), fixed.particles.floats(frame.position(), 3));
        if (swim.hasVelocity()) {
            points.ofPoints("Float32", "velocity", 3, fixed.particles.floats(frame.velocity(), 3));
        }
        if (swim.hasDensity()) {
            points.ofPoints("Float32", "density", 1, fixed.particles.floats(frame.density(), 1));
        }
        points.ofPoints("Float32", "mass", 1, fixed.mass);
        points.ofPoints("UInt8", "kind", 1, fixed.kind);
        points.ofPoints("Int32", "cluster", 1, fixed.cluster);
        points.ofPoints("Int32", "creature", 1, fixed.creature);
        points.ofPoints("Int32", "particle", 1, fixed.particle);
        points.cells("Verts", fixed.nodes, fixed.ends);
        return points;
    }

    private PolyData muscles(StreamFrame frame) {
        List<StreamScene.Muscle> muscles = swim.scene().muscles();
        ByteBuffer contraction = LittleEndian.buffer((long) muscles.size() * Float.BYTES);
        muscles.forEach(muscle -> contraction.putFloat(ExportContext.contraction(muscle, frame)));
        PolyData lines = new PolyData(frame.time(), swim.solids().floats(frame.position(), 3));
        lines.cells("Lines", muscleNodes, muscleEnds);
        lines.ofCells("Float32", "contraction", contraction.flip());
        lines.ofCells("Int32", "actuator", actuators);
        return lines;
    }

    private void write(PolyData data, StreamFrame frame, String name, int part) throws IOException {
        String path = String.format(Locale.ROOT, "%s/%s_%06d.vtp", name, name, frame.frame());
        Files.createDirectories(folder.resolve(name));
        data.write(folder.resolve(path));
        index.write("<DataSet timestep=\"" + frame.time() + "\" part=\"" + part + "\" name=\"" + name + "\" file=\""
                + path + "\"/>\n");
    }

    @Override
    public void finish() throws IOException {
        index.write("</Collection>\n</VTKFile>\n");
        index.close();
    }

    @Override
    public void close() throws IOException {
        index.close();
    }
}
