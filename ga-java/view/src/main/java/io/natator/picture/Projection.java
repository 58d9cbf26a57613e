package io.natator.picture;

/**
 * How places become pixels: parallel to the line of sight, so that lengths are the same near and far.
 *
 * @param from   the line of sight
 * @param centre x, y, z of what is in the middle of the picture
 * @param scale  pixels of a length unit
 * @param middle x and y of the pixel where the centre is
 */
record Projection(From from, double[] centre, double scale, double[] middle) {

    /** Pixels from the left edge. */
    double x(double px, double py, double pz) {
        return middle[0] + scale * along(0, px, py, pz);
    }

    /** Pixels from the upper edge. */
    double y(double px, double py, double pz) {
        return middle[1] - scale * along(1, px, py, pz);
    }

    /** Towards the viewer, pixels. */
    double depth(double px, double py, double pz) {
        return scale * along(2, px, py, pz);
    }

    private double along(int axis, double px, double py, double pz) {
        double[] unit = from.axis(axis);
        return unit[0] * (px - centre[0]) + unit[1] * (py - centre[1]) + unit[2] * (pz - centre[2]);
    }
}
