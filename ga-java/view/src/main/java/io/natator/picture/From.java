package io.natator.picture;

/** Where a picture is taken from; bodies swim along x, y is up. */
public enum From {
    /** The right side of the swimmer, which swims to the right of the picture. */
    SIDE(0, 0),
    /** Above; the swimmer swims to the right of the picture. */
    TOP(0, 90),
    /** Before the swimmer, which comes towards the viewer. */
    FRONT(90, 0),
    /** Above, and between side and front. */
    THREE_QUARTER(32, 24);

    private final double[][] axes;

    /**
     * A direction.
     *
     * @param azimuth   from the side towards the front, degrees
     * @param elevation above the horizon, degrees
     */
    From(double azimuth, double elevation) {
        double sinA = Math.sin(Math.toRadians(azimuth));
        double cosA = Math.cos(Math.toRadians(azimuth));
        double sinE = Math.sin(Math.toRadians(elevation));
        double cosE = Math.cos(Math.toRadians(elevation));
        axes = new double[][] {{cosA, 0, -sinA}, {-sinA * sinE, cosE, -cosA * sinE}, {sinA * cosE, sinE, cosA * cosE}};
    }

    /** Unit vectors of the scene to the right of the picture, to its top, and to the viewer. */
    double[] axis(int which) {
        return axes[which].clone();
    }
}
