package io.natator.kinematics;

import java.util.Arrays;

/**
 * One spine as a line z(x), x from the head on: the slices' (−x, z), rotated so that the line of best fit is parallel to
 * x, and shifted so that the head is at x = 0 and the mean of z is 0 (thesis 2.8). The line of best fit is that of least
 * squared distances at right angles (the first principal axis), so the result does not depend on the body's heading.
 */
final class Spine {

    private final double[] x;
    private final double[] z;

    private Spine(double[] x, double[] z) {
        this.x = x;
        this.z = z;
    }

    /**
     * The spine of one frame.
     *
     * @param centres of the slices from the head on, [slice][x, y, z]
     */
    static Spine of(double[][] centres) {
        double[] x = Arrays.stream(centres).mapToDouble(centre -> -centre[0]).toArray();
        double[] z = Arrays.stream(centres).mapToDouble(centre -> centre[2]).toArray();
        double meanX = Arrays.stream(x).average().orElseThrow();
        double meanZ = Arrays.stream(z).average().orElseThrow();
        double xx = 0;
        double xz = 0;
        double zz = 0;
        for (int i = 0; i < x.length; i++) {
            xx += (x[i] - meanX) * (x[i] - meanX);
            xz += (x[i] - meanX) * (z[i] - meanZ);
            zz += (z[i] - meanZ) * (z[i] - meanZ);
        }
        double angle = 0.5 * Math.atan2(2 * xz, xx - zz);
        int last = x.length - 1;
        if ((x[last] - x[0]) * Math.cos(angle) + (z[last] - z[0]) * Math.sin(angle) < 0) {
            angle += Math.PI;
        }
        double[] along = new double[x.length];
        double[] across = new double[x.length];
        for (int i = 0; i < x.length; i++) {
            along[i] = (x[i] - meanX) * Math.cos(angle) + (z[i] - meanZ) * Math.sin(angle);
            across[i] = (z[i] - meanZ) * Math.cos(angle) - (x[i] - meanX) * Math.sin(angle);
        }
        double head = along[0];
        for (int i = 0; i < along.length; i++) {
            along[i] -= head;
        }
        return new Spine(along, across);
    }

    /** How far the tail is from the head along the line of best fit. */
    double length() {
        return x[x.length - 1];
    }

    /**
     * z(x) by linear interpolation; where the spine folds back, the part nearest the head counts. Before the head and
     * beyond the tail it is what it is there.
     */
    double at(double place) {
        if (place <= x[0]) {
            return z[0];
        }
        for (int i = 1; i < x.length; i++) {
            if (x[i] >= place) {
                return z[i - 1] + (z[i] - z[i - 1]) * (place - x[i - 1]) / (x[i] - x[i - 1]);
            }
        }
        return z[z.length - 1];
    }

    double[] x() {
        return x.clone();
    }

    double[] z() {
        return z.clone();
    }
}
