package io.natator.spark;

/**
 * How many evaluations one after another are handed to an executor of a cluster. A part costs the driver some milliseconds
 * whatever is in it, so parts are large; but what an executor does not finish is lost, and at the end of a generation all wait
 * for the last part. So a part takes half of what is left for each slot (guided self-scheduling, Polychronopoulos and Kuck
 * 1987), and at most {@value #LONGEST} s, by the time that such evaluations took before.
 */
final class PartSize {

    /** Time of the longest parts, s. */
    static final double LONGEST = 2;
    /** Time below which a part is not made shorter, s: ten times what it costs. */
    static final double SHORTEST = 0.05;
    /** Of what is left, a part has one in so many for each slot. */
    private static final int SHARES = 2;

    private PartSize() {
    }

    /**
     * Evaluations of the next part, at least 1.
     *
     * @param left  time that all evaluations take which are in no part yet, s
     * @param each  time that one takes, s, above 0
     * @param slots parts that are done at the same time, at least 1
     */
    static int of(double left, double each, int slots) {
        double time = Math.max(SHORTEST, Math.min(LONGEST, left / (SHARES * slots)));
        return (int) Math.max(1, Math.min(time / each, Integer.MAX_VALUE));
    }
}
