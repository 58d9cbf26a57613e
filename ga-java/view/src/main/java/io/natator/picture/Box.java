package io.natator.picture;

import java.util.Arrays;

/**
 * A box along the axes of a scene.
 *
 * @param low  least x, y, z
 * @param high largest x, y, z
 */
record Box(double[] low, double[] high) {

    static final int AXES = 3;

    /** A box that holds nothing. */
    static Box empty() {
        double[] low = new double[AXES];
        double[] high = new double[AXES];
        Arrays.fill(low, Double.POSITIVE_INFINITY);
        Arrays.fill(high, Double.NEGATIVE_INFINITY);
        return new Box(low, high);
    }

    boolean isEmpty() {
        return low[0] > high[0];
    }

    double size(int axis) {
        return high[axis] - low[axis];
    }

    double middle(int axis) {
        return (low[axis] + high[axis]) / 2;
    }

    /** One of eight, by the bits of its number: which end along x, y and z. */
    double[] corner(int number) {
        double[] corner = new double[AXES];
        for (int axis = 0; axis < AXES; axis++) {
            corner[axis] = (number >> axis & 1) == 0 ? low[axis] : high[axis];
        }
        return corner;
    }

    /** The same with a margin on each side. */
    Box wider(double margin) {
        return new Box(Arrays.stream(low).map(value -> value - margin).toArray(),
                Arrays.stream(high).map(value -> value + margin).toArray());
    }

    /** The smallest box that holds another too. */
    Box with(Box other) {
        Box both = empty();
        for (int axis = 0; axis < AXES; axis++) {
            both.low[axis] = Math.min(low[axis], other.low[axis]);
            both.high[axis] = Math.max(high[axis], other.high[axis]);
        }
        return both;
    }

    /** The part that is in another box too. */
    Box within(Box other) {
        Box part = empty();
        for (int axis = 0; axis < AXES; axis++) {
            part.low[axis] = Math.max(low[axis], other.low[axis]);
            part.high[axis] = Math.min(high[axis], other.high[axis]);
        }
        return part;
    }

    /** The smallest box around some particles. */
    static Box around(float[] position, int[] particles) {
        Box box = empty();
        for (int particle : particles) {
            for (int axis = 0; axis < AXES; axis++) {
                double value = position[AXES * particle + axis];
                box.low[axis] = Math.min(box.low[axis], value);
                box.high[axis] = Math.max(box.high[axis], value);
            }
        }
        return box;
    }
}
