package io.natator.replay;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.Json;
import io.natator.stream.StreamFrame;
import io.natator.stream.StreamMessage;
import io.natator.stream.StreamScene;
import java.io.ByteArrayOutputStream;
import java.nio.ByteBuffer;
import java.nio.ByteOrder;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Comparator;
import java.util.DoubleSummaryStatistics;
import java.util.List;
import java.util.Map;
import java.util.function.Function;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

/**
 * A swim as bytes for the page: length of a text (u32), the text (JSON: what the rest is), tables. All little-endian, the
 * whole compressed by zlib. Tables are {@code float32} in rows of {@value #SCALARS} and the activations; places of the
 * water, places of all others, densities of the water, and of plane flow its velocities along x and z, as {@link TimeCode}.
 */
final class SwimCode {

    /** Time, distance, velocity (x, y, z), momentum, angular momentum, mean and largest density error. */
    static final int SCALARS = 9;
    /** Bits of a coordinate of the water. */
    static final int WATER_BITS = 16;
    /** Bits of a coordinate of the body. */
    static final int BODY_BITS = 20;
    static final int DENSITY_BITS = 8;
    static final int FLOW_BITS = 8;
    private static final int AXES = 3;
    /** Rows that are coded to find the better code of a table. */
    private static final int TRIED_ROWS = 40;
    private static final List<String> SCENE_KEYS = List.of("program", "scene", "overrides", "gait", "scheme",
            "precision",
            "timeStep", "solidRestDistance", "fluidRestDistance", "planes", "periodic", "particles", "fluid", "body",
            "slices",
            "bodyLength", "clusters", "joints", "actuators", "muscles", "skin");

    private final Replay swim;
    private final int[] water;
    private final int[] others;
    private final List<ByteBuffer> flows;

    /**
     * The code of a swim.
     *
     * @param withWater whether the water is to be seen
     */
    SwimCode(Replay swim, boolean withWater) {
        this.swim = swim;
        StreamScene scene = swim.scene();
        int first = scene.firstFluid();
        int end = first + scene.fluidCount();
        water = withWater ? IntStream.range(first, end).toArray() : new int[0];
        flows = withWater ? swim.waters() : List.of();
        others = IntStream.range(0, scene.particles()).filter(i -> i < first || i >= end).toArray();
    }

    /** Half of a step of the water and of the body: the largest error of a coordinate, on each axis, in length units. */
    double[][] largestErrors() {
        return new double[][] {halfSteps(places(water, WATER_BITS)), halfSteps(places(others, BODY_BITS))};
    }

    private static double[] halfSteps(Quantiser[] axes) {
        return IntStream.range(0, axes.length).mapToDouble(axis -> axes[axis].step() / 2).toArray();
    }

    /**
     * Codes every so many-th frame.
     *
     * @param every 1 for all
     */
    byte[] compressed(int every) {
        List<StreamFrame> frames = new ArrayList<>();
        for (int i = 0; i < swim.frames().size(); i += every) {
            frames.add(swim.frames().get(i));
        }
        ObjectNode head = JsonNodeFactory.instance.objectNode();
        ObjectNode facts = head.putObject("facts");
        swim.facts().forEach(facts::put);
        head.put("title", swim.title()).put("frames", frames.size()).put("scalars", SCALARS);
        head.set("scene", scene());
        ByteArrayOutputStream tables = new ByteArrayOutputStream();
        tables.writeBytes(scalars(frames));
        ArrayNode described = head.putArray("tables");
        addPlaces(frames, water, WATER_BITS, "water", described, tables);
        addPlaces(frames, others, BODY_BITS, "others", described, tables);
        addDensity(frames, described, tables);
        if (!flows.isEmpty()) {
            addFlow(frames, head, described, tables);
        }
        byte[] text = head.toString().getBytes(StandardCharsets.UTF_8);
        return Zlib.compressed(ByteBuffer.allocate(Integer.BYTES + text.length + tables.size())
                .order(ByteOrder.LITTLE_ENDIAN).putInt(text.length).put(text).put(tables.toByteArray()).array());
    }

    /** What the page needs of the scene; masses rounded to what a colour shows. */
    private ObjectNode scene() {
        JsonNode whole;
        try {
            whole = Json.parse(swim.json(), JsonNode.class);
        } catch (JsonProcessingException e) {
            throw new IllegalStateException(e);
        }
        ObjectNode scene = JsonNodeFactory.instance.objectNode();
        SCENE_KEYS.forEach(key -> scene.set(key, whole.get(key)));
        ObjectNode definition = scene.putObject("definition");
        definition.set("movingTank", whole.path("definition").get("movingTank"));
        if (!flows.isEmpty()) {
            definition.set("fluid", whole.get("definition").get("fluid"));
        }
        ArrayNode mass = scene.putArray("mass");
        for (Double one : swim.scene().mass()) {
            if (one == null) {
                mass.addNull();
            } else {
                mass.add(Math.round(one * 1e4) / 1e4);
            }
        }
        if (water.length == 0) {
            scene.putArray("fluid").add(swim.scene().firstFluid()).add(0);
        }
        return scene;
    }

    private static byte[] scalars(List<StreamFrame> frames) {
        int columns = SCALARS + frames.get(0).activation().length;
        ByteBuffer out = ByteBuffer.allocate(Float.BYTES * columns * frames.size()).order(ByteOrder.LITTLE_ENDIAN);
        for (StreamFrame frame : frames) {
            out.putFloat((float) frame.time()).putFloat((float) frame.distance());
            for (float component : frame.centreVelocity()) {
                out.putFloat(component);
            }
            out.putFloat(frame.linearMomentum()).putFloat(frame.angularMomentum()).putFloat(frame.meanDensityError())
                    .putFloat(frame.maxDensityError());
            for (float activation : frame.activation()) {
                out.putFloat(activation);
            }
        }
        return out.array();
    }

    private void addPlaces(List<StreamFrame> frames, int[] particles, int bits, String name, ArrayNode described,
            ByteArrayOutputStream out) {
        Quantiser[] axes = places(particles, bits);
        int[][] rows = new int[frames.size()][AXES * particles.length];
        for (int time = 0; time < rows.length; time++) {
            float[] position = frames.get(time).position();
            for (int axis = 0; axis < AXES; axis++) {
                for (int i = 0; i < particles.length; i++) {
                    rows[time][axis * particles.length + i] = axes[axis].of(position[AXES * particles[i] + axis]);
                }
            }
        }
        add(rows, axes, (bits + 7) / 8, name, described, out);
    }

    private void addDensity(List<StreamFrame> frames, ArrayNode described, ByteArrayOutputStream out) {
        double[] ends = ends(water, 1, 0, StreamFrame::density);
        Quantiser steps = Quantiser.over(ends[0], ends[1], DENSITY_BITS);
        int[][] rows = frames.stream()
                .map(frame -> IntStream.of(water).map(i -> steps.of(frame.density()[i])).toArray())
                .toArray(int[][]::new);
        add(rows, new Quantiser[] {steps}, 1, "density", described, out);
    }

    /** Water stays as it is until that of another frame is there. */
    private void addFlow(List<StreamFrame> frames, ObjectNode head, ArrayNode described, ByteArrayOutputStream out) {
        ByteBuffer first = flows.get(0);
        int cells = first.getInt(8) * first.getInt(12) * first.getInt(16);
        ObjectNode flow = head.putObject("flow").put("cell", first.getDouble(32));
        ArrayNode counts = flow.putArray("cells");
        ArrayNode corner = flow.putArray("corner");
        for (int axis = 0; axis < AXES; axis++) {
            counts.add(first.getInt(8 + Integer.BYTES * axis));
            corner.add(first.getDouble(40 + Double.BYTES * axis));
        }
        Map<Long, ByteBuffer> byFrame = flows.stream()
                .collect(Collectors.toMap(one -> Integer.toUnsignedLong(one.getInt(4)), Function.identity()));
        ArrayNode starts = flow.putArray("starts");
        Quantiser[] axes = {flowAlong(0), flowAlong(2)};
        int[][] rows = new int[frames.size()][];
        for (int time = 0; time < rows.length; time++) {
            ByteBuffer body = byFrame.get(frames.get(time).frame());
            if (body != null) {
                starts.add(time);
            }
            rows[time] = body == null ? rows[time - 1] : IntStream.range(0, 2 * cells)
                    .map(i -> axes[i / cells].of(velocity(body, i % cells, 2 * (i / cells)))).toArray();
        }
        add(rows, axes, 1, "flow", described, out);
    }

    private Quantiser flowAlong(int axis) {
        DoubleSummaryStatistics all = flows.stream()
                .flatMapToDouble(body -> IntStream
                        .range(0, (body.capacity() - StreamMessage.Water.HEAD_BYTES) / (4 * Float.BYTES))
                        .mapToDouble(cell -> velocity(body, cell, axis)))
                .summaryStatistics();
        return Quantiser.over(all.getMin(), all.getMax(), FLOW_BITS);
    }

    private static float velocity(ByteBuffer body, int cell, int axis) {
        return body.getFloat(StreamMessage.Water.HEAD_BYTES + Float.BYTES * (AXES * cell + axis));
    }

    /** Adds a table in the code that makes its beginning shorter. */
    private static void add(int[][] rows, Quantiser[] columns, int bytes, String name, ArrayNode described,
            ByteArrayOutputStream out) {
        int[][] beginning = Arrays.copyOf(rows, Math.min(rows.length, TRIED_ROWS));
        TimeCode.Expectation shorter = Arrays.stream(TimeCode.Expectation.values()).min(Comparator.comparingInt(
                one -> Zlib.compressed(TimeCode.encode(beginning, bytes, one)).length)).orElseThrow();
        ObjectNode table = described.addObject().put("name", name).put("bytes", bytes)
                .put("numbers", rows[0].length / columns.length).put("steady", shorter == TimeCode.Expectation.STEADY);
        ArrayNode axes = table.putArray("columns");
        for (Quantiser column : columns) {
            axes.addObject().put("low", column.low()).put("step", column.step());
        }
        out.writeBytes(TimeCode.encode(rows, bytes, shorter));
    }

    /** Steps over all places that these particles ever have, on each axis. */
    private Quantiser[] places(int[] particles, int bits) {
        return IntStream.range(0, AXES).mapToObj(axis -> {
            double[] ends = ends(particles, AXES, axis, StreamFrame::position);
            return Quantiser.over(ends[0], ends[1], bits);
        }).toArray(Quantiser[]::new);
    }

    private double[] ends(int[] particles, int components, int component, Function<StreamFrame, float[]> field) {
        double low = Double.POSITIVE_INFINITY;
        double high = Double.NEGATIVE_INFINITY;
        for (StreamFrame frame : swim.frames()) {
            float[] values = field.apply(frame);
            for (int particle : particles) {
                double value = values[components * particle + component];
                low = Math.min(low, value);
                high = Math.max(high, value);
            }
        }
        return low <= high ? new double[] {low, high} : new double[] {0, 1};
    }
}
