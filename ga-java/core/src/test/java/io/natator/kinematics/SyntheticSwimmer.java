package io.natator.kinematics;

/** Swimmers whose motion is given by a formula. */
final class SyntheticSwimmer {

    static final double LENGTH = 1.2;
    static final int SLICES = 49;
    static final double FREQUENCY = 1.25;
    /** Three beats. */
    private static final int FRAMES = 144;
    private static final double TIME_STEP = 1.0 / 60;

    /** Sideways place of the spine at a place and time. */
    interface Wave {
        double at(double x, double time);
    }

    private SyntheticSwimmer() {
    }

    /**
     * A body that moves so, seen in the scene: its spine's x points to −x, its heading is turned by an angle about y, and
     * it travels.
     */
    static SpinePath path(Wave wave, double heading, double speed) {
        double[] times = new double[FRAMES];
        double[][][] centres = new double[FRAMES][SLICES][];
        for (int frame = 0; frame < FRAMES; frame++) {
            times[frame] = frame * TIME_STEP;
            for (int slice = 0; slice < SLICES; slice++) {
                double x = LENGTH * slice / (SLICES - 1);
                double z = wave.at(x, times[frame]);
                double along = x * Math.cos(heading) - z * Math.sin(heading);
                double across = x * Math.sin(heading) + z * Math.cos(heading);
                centres[frame][slice] = new double[] {2 + speed * times[frame] - along, 0.3, 0.7 + across};
            }
        }
        return new SpinePath(times, centres);
    }
}
