package io.natator.export;

import io.natator.stream.StreamFrame;
import java.io.Closeable;
import java.io.IOException;
import java.io.Writer;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

/** A geometric prim whose points move; what stays the same about it is given as text. */
final class UsdPrim implements Closeable {

    private final String type;
    private final String name;
    private final Points points;
    private final Path folder;
    private final float margin;
    private final StringBuilder fixed = new StringBuilder();
    private final UsdSamples extent;
    private final List<Sampled> sampled = new ArrayList<>();

    /** An attribute and where its values come from. */
    private record Sampled(UsdSamples samples, Source source) {
    }

    /** Adds one frame's values. */
    @FunctionalInterface
    interface Source {
        void add(UsdSamples samples, StreamFrame frame) throws IOException;
    }

    /** Where its points are in a frame: x, y, z each. */
    @FunctionalInterface
    interface Points {
        float[] of(StreamFrame frame) throws IOException;
    }

    /**
     * A prim at these points.
     *
     * @param folder where values wait
     * @param type   its schema, for example {@code Points}
     * @param width  of what is drawn at a point, length
     */
    UsdPrim(Path folder, String type, String name, Points points, double width) throws IOException {
        this.folder = folder;
        this.type = type;
        this.name = name;
        this.points = points;
        this.margin = (float) (width / 2);
        this.extent = new UsdSamples(folder.resolve(name + "-extent"), "float3[] extent");
        sample("point3f[] points", (samples, frame) -> samples.add(frame.frame(), points.of(frame), 3));
    }

    /** An attribute with a value at every time. */
    void sample(String declaration, Source source) throws IOException {
        sampled.add(new Sampled(new UsdSamples(folder.resolve(name + "-" + sampled.size()), declaration), source));
    }

    /** An attribute with one value. */
    void fix(String assignment) {
        fixed.append("        ").append(assignment).append('\n');
    }

    void frame(StreamFrame frame) throws IOException {
        extent.add(frame.frame(), extentOf(points.of(frame)), 3);
        for (Sampled one : sampled) {
            one.source.add(one.samples, frame);
        }
    }

    private float[] extentOf(float[] places) {
        float[] corners = new float[6];
        for (int axis = 0; axis < 3; axis++) {
            float low = Float.POSITIVE_INFINITY;
            float high = Float.NEGATIVE_INFINITY;
            for (int i = axis; i < places.length; i += 3) {
                float value = places[i];
                low = Math.min(low, value);
                high = Math.max(high, value);
            }
            corners[axis] = low - margin;
            corners[axis + 3] = high + margin;
        }
        return corners;
    }

    /** Writes the whole prim. */
    void moveTo(Writer out) throws IOException {
        out.write("\n    def " + type + " \"" + name + "\"\n    {\n" + fixed);
        extent.moveTo(out);
        for (Sampled one : sampled) {
            one.samples.moveTo(out);
        }
        out.write("    }\n");
    }

    @Override
    public void close() throws IOException {
        extent.close();
        for (Sampled one : sampled) {
            one.samples.close();
        }
    }
}
