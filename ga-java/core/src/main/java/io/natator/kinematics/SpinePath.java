package io.natator.kinematics;

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

    /**
     * The same motion seen in the body's own upright: each frame is turned back about x by its roll, so that bending to a
     * body's side counts as sideways also where it has tipped over.
     *
     * @param attitude one per frame
     */
    public SpinePath unrolled(List<Attitude> attitude) {
        double[][][] turned = new double[centres.length][][];
        for (int frame = 0; frame < centres.length; frame++) {
            double cosine = Math.cos(attitude.get(frame).roll());
            double sine = Math.sin(attitude.get(frame).roll());
            turned[frame] = new double[centres[frame].length][];
            for (int slice = 0; slice < centres[frame].length; slice++) {
                double[] place = centres[frame][slice];
                turned[frame][slice] = new double[] {place[0], cosine * place[1] + sine * place[2],
                    cosine * place[2] - sine * place[1]};
            }
        }
        return new SpinePath(times, turned);
    }
}
