package io.natator.replay;

/**
 * Numbers as whole ones, at equal steps over a range.
 *
 * @param low  the number that is 0
 * @param step between neighbours; a number comes back with an error of at most half of it
 */
record Quantiser(double low, double step) {

    /**
     * Steps for numbers from {@code low} to {@code high}.
     *
     * @param bits of the whole numbers, 1 to 31
     */
    static Quantiser over(double low, double high, int bits) {
        double range = high - low;
        return new Quantiser(low, (range > 0 ? range : 1) / ((1L << bits) - 1));
    }

    /** The nearest whole number. */
    int of(double value) {
        return (int) Math.round((value - low) / step);
    }
}
