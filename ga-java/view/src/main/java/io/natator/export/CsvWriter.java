package io.natator.export;

import io.natator.stream.StreamFrame;
import java.io.BufferedWriter;
import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;

/** One table, {@code swim.csv}: a row for each particle in each frame. Numbers have all their digits. */
final class CsvWriter implements FrameWriter {

    private final ExportContext swim;
    private final BufferedWriter out;

    CsvWriter(ExportContext swim, Path folder) throws IOException {
        this.swim = swim;
        this.out = Files.newBufferedWriter(folder.resolve("swim.csv"));
        out.write("frame,time,particle,kind,x,y,z" + (swim.hasVelocity() ? ",vx,vy,vz" : "")
                + (swim.hasDensity() ? ",density" : "") + "\n");
    }

    @Override
    public void frame(StreamFrame frame) throws IOException {
        ParticleSet shown = swim.shown();
        StringBuilder row = new StringBuilder();
        for (int i = 0; i < shown.size(); i++) {
            int particle = shown.index(i);
            row.setLength(0);
            row.append(frame.frame()).append(',').append(frame.time()).append(',').append(particle).append(',')
                    .append(shown.kind(i).text());
            append(row, frame.position(), 3, particle);
            append(row, frame.velocity(), swim.hasVelocity() ? 3 : 0, particle);
            append(row, frame.density(), swim.hasDensity() ? 1 : 0, particle);
            out.append(row.append('\n'));
        }
    }

    private static void append(StringBuilder row, float[] values, int components, int particle) {
        for (int i = particle * components; i < (particle + 1) * components; i++) {
            row.append(',').append(values[i]);
        }
    }

    @Override
    public void finish() throws IOException {
        out.close();
    }

    @Override
    public void close() throws IOException {
        out.close();
    }
}
