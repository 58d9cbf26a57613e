package io.natator.kinematics;

import java.util.List;
import java.util.stream.Stream;

/**
 * The lateral motion z(x, t) of a swimmer's spine, free of its travel and heading.
 */
public final class Swimming implements LateralMotion {

    private final double[] times;
    private final List<Spine> spines;
    private final double length;
    private final double measuredLength;

    /**
     * Takes the motion out of a path.
     *
     * @param path all frames count, those of setting off too, as in the thesis
     */
    public Swimming(SpinePath path) {
        this(path, path.restLength());
    }

    /**
     * Takes the motion out of a part of a path, in which the body is not straight at first.
     *
     * @param length of the body at rest, above 0
     */
    public Swimming(SpinePath path, double length) {
        times = path.times().clone();
        spines = Stream.of(path.centres()).map(Spine::of).toList();
        this.length = length;
        measuredLength = Math.max(spines.stream().mapToDouble(Spine::length).min().orElseThrow(), length / 10);
    }

    @Override
    public double length() {
        return length;
    }

    /**
     * x_l: the shortest that the bent spine gets, so that z(x, t) is measured at all times up to there; at least a tenth
     * of L.
     */
    @Override
    public double measuredLength() {
        return measuredLength;
    }

    @Override
    public double[] times() {
        return times.clone();
    }

    @Override
    public double lateral(int frame, double x) {
        return spines.get(frame).at(x);
    }

    /** A frame's spine as a line: x of the slices from the head on, and their z. */
    public double[][] line(int frame) {
        return new double[][] {spines.get(frame).x(), spines.get(frame).z()};
    }

    /** a(x) = max over t of |z(x, t)| (thesis eq. 2.13). */
    public double envelope(double x) {
        return spines.stream().mapToDouble(spine -> Math.abs(spine.at(x))).max().orElseThrow();
    }
}
