package io.natator.view;

import com.fasterxml.jackson.databind.JsonNode;
import io.natator.kinematics.Attitude;
import io.natator.kinematics.FishMode;
import io.natator.kinematics.ModeFit;
import io.natator.kinematics.SpinePath;
import io.natator.kinematics.Swimming;
import io.natator.stream.StreamFrame;
import io.natator.stream.StreamScene;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.Deque;
import java.util.List;
import java.util.stream.DoubleStream;
import java.util.stream.StreamSupport;

/**
 * How a watched body has moved of late: its spine in the frames of the last whole beats. Frames may be missing; those
 * there are count alike.
 */
final class LiveKinematics {

    /** As many whole beats as fit in here, but at least one. */
    private static final double WINDOW_SECONDS = 2;
    /** Room for a beat of 20 s with 60 frames a second; of a longer one nothing is said. */
    private static final int MOST_FRAMES = 1200;
    /** A fit over more takes long and says little more. */
    private static final int FITTED_FRAMES = 48;
    private static final int LEAST_FRAMES = 8;
    static final int PLACES = 25;

    private final Deque<Moment> moments = new ArrayDeque<>();
    private StreamScene scene;
    private double frequency;
    private double[][] start;

    /** The slices' centres, [slice from the head][x, y, z], and how the body is turned against the start. */
    private record Moment(double time, double[][] centres, Attitude attitude) {
    }

    /**
     * What is said about the motion. Lengths in body lengths, places from 0 at the head to 1 at the tail.
     *
     * @param frequency of the beat, in 1/s
     * @param frames    that it is drawn from
     * @param envelope  [place, amplitude] pairs
     * @param modes     the best fit to each real fish
     * @param nearest   name of the one that the motion is nearest to; null if it is like none ({@link ModeFit#nearest})
     */
    record Analysis(double frequency, int frames, List<double[]> envelope, List<Mode> modes, String nearest) {
    }

    /**
     * A fit to a real fish.
     *
     * @param name     of its mode
     * @param alpha    as in {@link ModeFit}
     * @param beta     s
     * @param e        error, 0 for the same motion
     * @param envelope [place, amplitude] pairs of the real fish at this frequency
     */
    record Mode(String name, double alpha, double beta, double e, List<double[]> envelope) {
    }

    /** A scene begins, or goes on under other settings; beats of another gait do not count any more. */
    void begin(StreamScene next) {
        if (next.restarted()) {
            start = null;
        }
        scene = next;
        frequency = beats(next.gait()) ? next.gait().path("frequency").asDouble() : 0;
        moments.clear();
    }

    private static boolean beats(JsonNode gait) {
        return gait != null && StreamSupport.stream(gait.path("amplitude").spliterator(), false)
                .anyMatch(amplitude -> amplitude.asDouble() > 0);
    }

    /** Adds a frame of the scene; one without a body that beats is ignored. */
    void add(StreamFrame frame) {
        if (!(frequency > 0) || scene.slices().size() < 2 || frame.position().length == 0
                || !moments.isEmpty() && frame.time() == moments.getLast().time) {
            return;
        }
        if (!moments.isEmpty() && frame.time() < moments.getLast().time) {
            moments.clear();
        }
        double[][] centres = scene.slices().stream().map(slice -> centre(frame, slice)).toArray(double[][]::new);
        if (!Arrays.stream(centres).flatMapToDouble(DoubleStream::of).allMatch(Double::isFinite)) {
            return;
        }
        double[][] body = scene.body().stream().map(particle -> place(frame, particle)).toArray(double[][]::new);
        if (start == null) {
            start = body;
        }
        moments.add(new Moment(frame.time(), centres, Attitude.of(start, body)));
        double oldest = frame.time() - keptSeconds();
        while (moments.size() > MOST_FRAMES || moments.getFirst().time < oldest) {
            moments.removeFirst();
        }
    }

    /** Half a beat more than is needed, so that the whole ones are there even if the frame at their start is missing. */
    private double keptSeconds() {
        return (Math.max(1, Math.floor(WINDOW_SECONDS * frequency)) + 0.5) / frequency;
    }

    private static double[] place(StreamFrame frame, int particle) {
        return new double[] {frame.position()[3 * particle], frame.position()[3 * particle + 1],
            frame.position()[3 * particle + 2]};
    }

    private static double[] centre(StreamFrame frame, List<Integer> particles) {
        double[] mean = new double[3];
        for (int particle : particles) {
            for (int axis = 0; axis < mean.length; axis++) {
                mean[axis] += frame.position()[3 * particle + axis] / particles.size();
            }
        }
        return mean;
    }

    /** The frames of the last whole beats, thinned; null before there are any. */
    Beats lastBeats() {
        if (moments.size() < LEAST_FRAMES) {
            return null;
        }
        double end = moments.getLast().time;
        double beats = Math.floor((end - moments.getFirst().time + scene.timeStep() / 2) * frequency);
        if (beats < 1) {
            return null;
        }
        List<Moment> whole = moments.stream().filter(moment -> moment.time > end - beats / frequency).toList();
        int step = (whole.size() + FITTED_FRAMES - 1) / FITTED_FRAMES;
        List<Moment> thinned = new ArrayList<>();
        for (int i = 0; i < whole.size(); i += step) {
            thinned.add(whole.get(i));
        }
        return thinned.size() < LEAST_FRAMES ? null : new Beats(frequency, scene.bodyLength(), new SpinePath(
                thinned.stream().mapToDouble(Moment::time).toArray(),
                thinned.stream().map(Moment::centres).toArray(double[][][]::new))
                .unrolled(thinned.stream().map(Moment::attitude).toList()));
    }

    /** Spines of whole beats; nothing changes them any more. */
    record Beats(double frequency, double bodyLength, SpinePath spine) {

        /** Measures the motion; takes some milliseconds. */
        Analysis analyse() {
            Swimming swimming = new Swimming(spine, bodyLength);
            List<double[]> envelope = places(swimming.measuredLength() / bodyLength).mapToObj(share ->
                    new double[] {share, swimming.envelope(share * bodyLength) / bodyLength}).toList();
            List<ModeFit> fits = ModeFit.all(swimming, frequency);
            List<Mode> modes = fits.stream().map(fit -> new Mode(fit.mode().label(),
                    fit.alpha(), fit.beta(), fit.error(), fishEnvelope(fit.mode(), frequency))).toList();
            return new Analysis(frequency, spine.frames(), envelope, modes,
                    ModeFit.nearest(fits).map(fit -> fit.mode().label()).orElse(null));
        }
    }

    /** The envelope of a real fish in body lengths, [place, amplitude] pairs from head to tail; frequency in 1/s. */
    static List<double[]> fishEnvelope(FishMode mode, double frequency) {
        return places(1).mapToObj(share -> new double[] {share, Math.abs(mode.amplitude(share, 1, frequency))}).toList();
    }

    private static DoubleStream places(double end) {
        return DoubleStream.iterate(0, i -> i + 1).limit(PLACES).map(i -> end * i / (PLACES - 1));
    }
}
