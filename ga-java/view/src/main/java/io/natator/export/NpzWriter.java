package io.natator.export;

import io.natator.stream.StreamFrame;
import io.natator.stream.StreamScene;
import java.io.BufferedOutputStream;
import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.LocalDateTime;
import java.util.ArrayList;
import java.util.List;
import java.util.zip.Deflater;
import java.util.zip.ZipEntry;
import java.util.zip.ZipOutputStream;

/**
 * For numpy: {@code swim.npz}. T frames, N particles, A actuators, C clusters, M muscles. Muscles and clusters name
 * particles by their place in the arrays.
 */
final class NpzWriter implements FrameWriter {

    /** The same export gives the same bytes. */
    private static final LocalDateTime ENTRY_TIME = LocalDateTime.of(1980, 1, 1, 0, 0);

    private final ExportContext swim;
    private final Path file;
    private final List<NpyColumn> columns = new ArrayList<>();

    NpzWriter(ExportContext swim, Path folder) throws IOException {
        this.swim = swim;
        this.file = folder.resolve("swim.npz");
        int particles = swim.shown().size();
        columns.add(new NpyColumn(folder, "time", "<f8"));
        columns.add(new NpyColumn(folder, "frame", "<i4"));
        columns.add(new NpyColumn(folder, "distance", "<f8"));
        columns.add(new NpyColumn(folder, "activation", "<f4", swim.scene().actuators()));
        columns.add(new NpyColumn(folder, "position", "<f4", particles, 3));
        if (swim.hasVelocity()) {
            columns.add(new NpyColumn(folder, "velocity", "<f4", particles, 3));
        }
        if (swim.hasDensity()) {
            columns.add(new NpyColumn(folder, "density", "<f4", particles));
        }
    }

    @Override
    public void frame(StreamFrame frame) throws IOException {
        for (NpyColumn column : columns) {
            column.add(switch (column.name()) {
                case "time" -> LittleEndian.doubles(frame.time());
                case "frame" -> LittleEndian.ints((int) frame.frame());
                case "distance" -> LittleEndian.doubles(frame.distance());
                case "activation" -> LittleEndian.floats(frame.activation());
                case "position" -> swim.shown().floats(frame.position(), 3);
                case "velocity" -> swim.shown().floats(frame.velocity(), 3);
                default -> swim.shown().floats(frame.density(), 1);
            });
        }
    }

    @Override
    public void finish() throws IOException {
        try (ZipOutputStream zip = new ZipOutputStream(new BufferedOutputStream(Files.newOutputStream(file)))) {
            zip.setLevel(Deflater.NO_COMPRESSION);  // floats of a motion hardly compress
            for (NpyColumn column : columns) {
                begin(zip, column.name());
                column.moveTo(zip);
            }
            addFixed(zip);
        }
    }

    private void addFixed(ZipOutputStream zip) throws IOException {
        ParticleSet shown = swim.shown();
        List<StreamScene.Muscle> muscles = swim.scene().muscles();
        int particles = shown.size();
        add(zip, "particle", "<i4", shown.indices(), particles);
        add(zip, "mass", "<f4", shown.masses(), particles);
        add(zip, "kind", "|u1", shown.kinds(), particles);
        add(zip, "creature", "<i4", shown.creatures(), particles);
        add(zip, "cluster_creature", "<i4", clusterCreatures(), swim.scene().clusters().size());
        add(zip, "cluster", "|b1", membership(), swim.scene().clusters().size(), particles);
        add(zip, "muscle", "<i4", LittleEndian.ints(swim.muscleEnds(shown)), muscles.size(), 2);
        add(zip, "muscle_actuator", "<i4",
                LittleEndian.ints(muscles.stream().mapToInt(StreamScene.Muscle::actuator).toArray()), muscles.size());
        ByteBuffer lateral = LittleEndian.buffer((long) muscles.size() * Float.BYTES);
        ByteBuffer restLength = LittleEndian.buffer((long) muscles.size() * Float.BYTES);
        for (StreamScene.Muscle muscle : muscles) {
            lateral.putFloat((float) muscle.lateral());
            restLength.putFloat((float) muscle.restLength());
        }
        add(zip, "muscle_lateral", "<f4", lateral.flip(), muscles.size());
        add(zip, "muscle_rest_length", "<f4", restLength.flip(), muscles.size());
        add(zip, "surface", "<i4", LittleEndian.ints(swim.surface().corners(shown)), swim.surface().size(), 3);
    }

    private ByteBuffer clusterCreatures() {
        int[] creatures = ParticleSet.creatures(swim.scene());
        return LittleEndian.ints(swim.scene().clusters().stream()
                .mapToInt(cluster -> cluster.isEmpty() ? ParticleSet.NO_CREATURE : creatures[cluster.get(0)]).toArray());
    }

    /** For every cluster, of each particle, whether it belongs to it. */
    private ByteBuffer membership() {
        int particles = swim.shown().size();
        List<List<Integer>> clusters = swim.scene().clusters();
        ByteBuffer members = LittleEndian.buffer((long) clusters.size() * particles);
        for (int i = 0; i < clusters.size(); i++) {
            for (int particle : clusters.get(i)) {
                members.put(i * particles + swim.shown().placeOf(particle), (byte) 1);
            }
        }
        return members;
    }

    private static void add(ZipOutputStream zip, String name, String type, ByteBuffer values, int... shape)
            throws IOException {
        begin(zip, name);
        zip.write(NpyColumn.header(type, shape));
        zip.write(values.array(), values.arrayOffset() + values.position(), values.remaining());
    }

    private static void begin(ZipOutputStream zip, String name) throws IOException {
        ZipEntry entry = new ZipEntry(name + ".npy");
        entry.setTimeLocal(ENTRY_TIME);
        zip.putNextEntry(entry);
    }

    @Override
    public void close() throws IOException {
        for (NpyColumn column : columns) {
            column.close();
        }
    }
}
