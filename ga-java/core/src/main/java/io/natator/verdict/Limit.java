package io.natator.verdict;

/** The limits by which winners are judged. */
final class Limit {
    /** Body lengths, or scene units where the length is unknown, below which a whole run is no swim. */
    static final double MIN_DISTANCE = 0.05;
    /** Share of the speed in water up to which a drift in vacuum counts as none. */
    static final double NO_DRIFT = 0.1;
    /** Share of the speed in water from which the drift in vacuum is the motion. */
    static final double DRIFT_ONLY = 0.5;
    /** Body lengths before a wall within which a swim cannot be judged. */
    static final double WAY_TO_WALL = 0.5;
    /** Standard errors on either side of a mean within which the true one is taken to lie. */
    static final double SURE = 2;
    /** Share of its way that a swimmer keeps under another condition, such as mirrored. */
    static final double MIN_LEFT = 0.5;
    /** Share of the way by which half the time step may change it. */
    static final double MAX_CHANGE = 0.5;
    /** Share of its worth that a winner may lose from fresh starts. */
    static final double MAX_LOSS = 0.05;
    /** Share of the speed that finer steps may change where it is called converged. */
    static final double CONVERGED = 0.1;

    private Limit() {
    }
}
