package io.natator.verdict;

/** Whether a swim at half the time step is still the same swim. */
final class HalfStep {

    /** What is expected, in words. */
    static final String EXPECTED = "its way to within half of it";

    private HalfStep() {
    }

    /**
     * Whether two ways agree. One that gets much longer is as far from converged as one that gets much shorter.
     *
     * @param way    at the time step, in any unit
     * @param atHalf at half of it, in the same
     */
    static boolean agrees(double way, double atHalf) {
        return Math.abs(atHalf - way) <= Limit.MAX_CHANGE * Math.abs(way);
    }

    /** How the two ways disagree, in words; null if they agree. */
    static String doubt(double way, double atHalf) {
        return agrees(way, atHalf) ? null
                : (atHalf - way) * way > 0 ? "it gets more than half as far again at half the time step"
                        : "it loses more than half at half the time step";
    }
}
