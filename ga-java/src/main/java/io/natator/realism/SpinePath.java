package io.natator.realism;

import java.util.ArrayList;
import java.util.List;

/**
 * Centres of a body's slices over time.
 *
 * @param times   in seconds, ascending, one per frame
 * @param centres [frame][slice from the head][x, y, z] in scene units
 */
public record SpinePath(double[] times, double[][][] centres) {

    /**
     * Checks the sizes.
     *
     * @throws IllegalArgumentException if there is no frame, or frames differ in slices or have fewer than two
     */
    public SpinePath {
        if (times.length == 0 || times.length != centres.length) {
            throw new IllegalArgumentException(times.length + " times and " + centres.length
                    + " frames; expected as many of both, at least one");
        }
        for (double[][] frame : centres) {
            if (frame.length < 2 || frame.length != centres[0].length) {
                throw new IllegalArgumentException("a frame of " + frame.length
                        + " slices; expected at least two, as many in every frame");
            }
        }
    }

    /** Number of frames. */
    public int frames() {
        return times.length;
    }

    /** Head to tail along the spine in the first frame, when it is straight. */
    public double restLength() {
        double length = 0;
        for (int i = 1; i < centres[0].length; i++) {
            double sum = 0;
            for (int axis = 0; axis < 3; axis++) {
                double step = centres[0][i][axis] - centres[0][i - 1][axis];
                sum += step * step;
            }
            length += Math.sqrt(sum);
        }
        return length;
    }

    /** The part from a time on. */
    public SpinePath from(double time) {
        List<double[][]> kept = new ArrayList<>();
        List<Double> moments = new ArrayList<>();
        for (int i = 0; i < times.length; i++) {
            if (times[i] >= time) {
                kept.add(centres[i]);
                moments.add(times[i]);
            }
        }
        return new SpinePath(moments.stream().mapToDouble(Double::doubleValue).toArray(),
                kept.toArray(double[][][]::new));
    }
}
