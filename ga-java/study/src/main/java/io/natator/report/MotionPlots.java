package io.natator.report;

import io.natator.kinematics.Attitude;
import io.natator.kinematics.FishMode;
import io.natator.kinematics.ModeFit;
import io.natator.kinematics.SpinePath;
import io.natator.kinematics.Swimming;
import io.natator.plot.Picture;
import java.io.IOException;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.Locale;
import java.util.function.ToDoubleFunction;
import java.util.stream.IntStream;
import java.util.stream.Stream;
import org.knowm.xchart.XYChart;

/**
 * How a recorded body moved: the thesis' figures 3.1 to 3.4, each as a PNG file. The spine's sideways motion is that in
 * the body's own plane, so that a body which has tipped over still shows how it bends.
 */
public final class MotionPlots {

    private static final int PLACES = 49;
    private static final int PHASES = 4;
    /** Number of its colour and dashes, of none of the phases. */
    private static final int ENVELOPE = 5;
    /** Room above and below what is drawn. */
    private static final double MARGIN = 1.15;
    private static final String FROM_THE_HEAD = "from the head (body lengths)";
    /** One frame of so many is drawn over time, which keeps the files small. */
    private static final int FRAMES_PER_POINT = 3;

    private final String title;
    private final Recording recording;
    private final Swimming swimming;
    private final double frequency;
    private final Path folder;

    /**
     * Pictures of a recording.
     *
     * @param title  what swims
     * @param folder where they go
     */
    public MotionPlots(String title, Recording recording, Path folder) {
        this.title = title;
        this.recording = recording;
        this.swimming = new Swimming(recording.unrolled());
        this.frequency = recording.request().gait().frequency();
        this.folder = folder;
    }

    /** Figure 3.1, first half: where the body's centre is over time. */
    public Path position(String name) throws IOException {
        XYChart chart = Charts.lines(title + ": position", "time (s)", "from the start (scene units)");
        double[] times = thinned(recording.spine().times());
        String[] axes = {"x (forwards)", "y (up)", "z (right)"};
        for (int axis = 0; axis < axes.length; axis++) {
            int of = axis;
            double[] start = recording.centres()[0];
            double[] values = Arrays.stream(recording.centres()).mapToDouble(centre -> centre[of] - start[of]).toArray();
            Charts.add(chart, axes[axis], times, thinned(values), axis, 2f);
        }
        return Picture.save(chart, folder.resolve(name));
    }

    /** Figure 3.1, second half: how it is turned. */
    public Path rotation(String name) throws IOException {
        XYChart chart = Charts.lines(title + ": rotation", "time (s)", "turned by (degrees)");
        double[] times = thinned(recording.spine().times());
        Charts.add(chart, "θ about x", times, degrees(Attitude::roll), 0, 2f);
        Charts.add(chart, "ρ about y", times, degrees(Attitude::yaw), 1, 2f);
        Charts.add(chart, "ω about z", times, degrees(Attitude::pitch), 2, 2f);
        return Picture.save(chart, folder.resolve(name));
    }

    private double[] degrees(ToDoubleFunction<Attitude> angle) {
        return thinned(recording.attitude().stream().mapToDouble(one -> Math.toDegrees(angle.applyAsDouble(one)))
                .toArray());
    }

    private static double[] thinned(double[] values) {
        return IntStream.range(0, values.length).filter(i -> i % FRAMES_PER_POINT == 0).mapToDouble(i -> values[i])
                .toArray();
    }

    /** Figure 3.2: the spine in four phases of the last beat, with the envelope of all times. */
    public Path spines(String name) throws IOException {
        double length = swimming.length();
        double[] shares = scaled(places(swimming.measuredLength()), 1 / length);
        double[] envelope = envelope();
        double[][][] lines = IntStream.range(0, PHASES).mapToObj(phase -> swimming.line(frameOfPhase(phase))).toArray(double[][][]::new);
        double widest = Math.max(largest(envelope), Stream.of(lines).mapToDouble(line -> largest(line[1]) / length).max().orElseThrow());
        double least = Stream.of(lines).mapToDouble(line -> Arrays.stream(line[0]).min().orElseThrow() / length).min().orElseThrow();
        return Picture.save(Charts.toScale(title + ": spine in four phases, envelope", FROM_THE_HEAD, "sideways (body lengths)",
                Math.min(0, least), 1, MARGIN * widest, chart -> {
                    Charts.add(chart, "envelope", shares, envelope, ENVELOPE, 1.5f);
                    Charts.add(chart, "− envelope", shares, scaled(envelope, -1), ENVELOPE, 1.5f).setShowInLegend(false);
                    for (int phase = 0; phase < PHASES; phase++) {
                        Charts.add(chart, label(phase), scaled(lines[phase][0], 1 / length), scaled(lines[phase][1], 1 / length),
                                phase, 2f);
                    }
                }), folder.resolve(name));
    }

    /** Figure 3.3: the envelope against those of real fish. */
    public Path envelopes(String name) throws IOException {
        XYChart chart = Charts.lines(title + ": envelope against real fish", FROM_THE_HEAD, "amplitude (body lengths), stretched");
        double length = swimming.length();
        Charts.add(chart, "simulated", scaled(places(swimming.measuredLength()), 1 / length), envelope(), 0, 3f);
        double[] whole = places(length);
        for (FishMode mode : FishMode.values()) {
            Charts.add(chart, mode.label(), scaled(whole, 1 / length),
                    Arrays.stream(whole).map(x -> Math.abs(mode.amplitude(x, length, frequency)) / length).toArray(),
                    1 + mode.ordinal(), 1.5f);
        }
        return Picture.save(chart, folder.resolve(name));
    }

    /** Figure 3.4: the spine scaled by α against the real fish that it fits, in four phases. */
    public Path scaled(String name, FishMode mode) throws IOException {
        ModeFit fit = ModeFit.of(swimming, mode, frequency);
        double length = swimming.length();
        double[] measured = places(swimming.measuredLength());
        double[] whole = places(length);
        double widest = Math.max(fit.alpha() * largest(envelope()),
                Arrays.stream(whole).map(x -> mode.amplitude(x, length, frequency)).map(Math::abs).max().orElseThrow() / length);
        String heading = String.format(Locale.ROOT, "%s, scaled by %.2f, %s %s fish (thin): e = %.4f", title, fit.alpha(),
                fit.resembles() ? "and" : "not like", mode.label(), fit.error());
        return Picture.save(Charts.toScale(heading, FROM_THE_HEAD, "sideways (body lengths)", 0, 1, MARGIN * widest, chart -> {
            for (int phase = 0; phase < PHASES; phase++) {
                int frame = frameOfPhase(phase);
                double time = recording.spine().times()[frame];
                double[] spine = Arrays.stream(measured).map(x -> fit.alpha() * swimming.lateral(frame, x) / length).toArray();
                Charts.add(chart, label(phase), scaled(measured, 1 / length), spine, phase, 2.5f);
                double[] real = Arrays.stream(whole)
                        .map(x -> mode.lateral(x, time - fit.beta(), length, frequency) / length).toArray();
                Charts.add(chart, mode.label() + " " + phase, scaled(whole, 1 / length), real, phase, 1f).setShowInLegend(false);
            }
        }), folder.resolve(name));
    }

    /**
     * Up to which part of the body its motion is known at all times. Pictures end there: a spine that is bent is shorter along
     * its line than the body is at rest, and the thesis measures up to where the shortest one ends.
     */
    public double measuredPart() {
        return swimming.measuredLength() / swimming.length();
    }

    private double[] envelope() {
        return Arrays.stream(places(swimming.measuredLength())).map(x -> swimming.envelope(x) / swimming.length()).toArray();
    }

    private static double largest(double[] values) {
        return Arrays.stream(values).map(Math::abs).max().orElseThrow();
    }

    private String label(int phase) {
        return String.format(Locale.ROOT, "%d/%d, %.2f s", phase, PHASES, recording.spine().times()[frameOfPhase(phase)]);
    }

    /** The frame nearest to a phase of the last whole beat. */
    private int frameOfPhase(int phase) {
        SpinePath spine = recording.spine();
        double end = spine.times()[spine.frames() - 1];
        double moment = Math.max(0, end - (PHASES - phase) / (PHASES * frequency));
        return IntStream.range(0, spine.frames()).boxed()
                .min((a, b) -> Double.compare(Math.abs(spine.times()[a] - moment), Math.abs(spine.times()[b] - moment)))
                .orElseThrow();
    }

    private static double[] places(double end) {
        double[] places = new double[PLACES];
        Arrays.setAll(places, i -> end * i / (PLACES - 1));
        return places;
    }

    private static double[] scaled(double[] values, double factor) {
        return Arrays.stream(values).map(value -> value * factor).toArray();
    }
}
