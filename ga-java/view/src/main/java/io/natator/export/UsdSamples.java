package io.natator.export;

import java.io.BufferedWriter;
import java.io.Closeable;
import java.io.IOException;
import java.io.Writer;
import java.nio.file.Files;
import java.nio.file.Path;

/** The values of one USD attribute at all times; they wait in a file of their own. */
final class UsdSamples implements Closeable {

    private final String declaration;
    private final Path file;
    private final BufferedWriter out;

    /**
     * An attribute without values.
     *
     * @param file        where they wait
     * @param declaration type and name, for example {@code point3f[] points}
     */
    UsdSamples(Path file, String declaration) throws IOException {
        this.declaration = declaration;
        this.file = file;
        this.out = Files.newBufferedWriter(file);
    }

    /** Adds the values of some particles at one time. */
    void add(long timeCode, ParticleSet particles, float[] values, int components) throws IOException {
        out.write("            " + timeCode + ": [");
        StringBuilder text = new StringBuilder();
        for (int i = 0; i < particles.size(); i++) {
            text.setLength(0);
            text.append(i == 0 ? "" : ", ");
            append(text, values, particles.index(i) * components, components);
            out.append(text);
        }
        out.write("],\n");
    }

    /** Adds an array of numbers, or of tuples of them. */
    void add(long timeCode, float[] values, int components) throws IOException {
        StringBuilder text = new StringBuilder("            ").append(timeCode).append(": [");
        for (int i = 0; i < values.length; i += components) {
            text.append(i == 0 ? "" : ", ");
            append(text, values, i, components);
        }
        out.append(text.append("],\n"));
    }

    /** Adds whole numbers. */
    void add(long timeCode, int[] values) throws IOException {
        out.append("            " + timeCode + ": ").append(UsdText.list(values)).append(",\n");
    }

    private static void append(StringBuilder text, float[] values, int from, int components) {
        if (components == 1) {
            text.append(UsdText.number(values[from]));
            return;
        }
        for (int i = 0; i < components; i++) {
            text.append(i == 0 ? "(" : ", ").append(UsdText.number(values[from + i]));
        }
        text.append(')');
    }

    /** Writes the attribute and removes the file in which it waited. */
    void moveTo(Writer target) throws IOException {
        out.close();
        target.write("        " + declaration + ".timeSamples = {\n");
        try (var waiting = Files.newBufferedReader(file)) {
            waiting.transferTo(target);
        }
        target.write("        }\n");
        Files.delete(file);
    }

    @Override
    public void close() throws IOException {
        out.close();
    }
}
