package io.natator.kinematics;

/** How a spine moves sideways: z(x, t), x from the head on. */
public interface LateralMotion {

    /** The moments, in seconds. */
    double[] times();

    /** L: length of the body at rest, in scene units. */
    double length();

    /** x_l: the place up to which z(x, t) is known at all times. */
    double measuredLength();

    /**
     * z at a place and one of the moments.
     *
     * @param frame number of the moment, from 0
     * @param x     0 to {@link #measuredLength}
     */
    double lateral(int frame, double x);
}
