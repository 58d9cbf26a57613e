package io.natator.evolution;

/**
 * Seeds for the parts of a run, mixed as in SplitMix64 (Steele, Lea, Flood 2014); of them numbers of the simulator's starts. All
 * gaits of a generation begin from the same ones, so that they are compared under the same conditions; every generation has its
 * own.
 */
public final class Seeds {

    private static final long GOLDEN_RATIO = 0x9E3779B97F4A7C15L;

    /** The simulator takes 31 bits of a start; the uppermost tells the fresh ones. */
    private static final int START_BITS = 30;

    private Seeds() {
    }

    /** The seed of the part with this number, from 0. */
    static long of(long runSeed, int part) {
        long z = runSeed + (part + 1) * GOLDEN_RATIO;
        z = (z ^ (z >>> 30)) * 0xBF58476D1CE4E5B9L;
        z = (z ^ (z >>> 27)) * 0x94D049BB133111EBL;
        return z ^ (z >>> 31);
    }

    /**
     * A start of a generation.
     *
     * @param number from 0
     */
    static int start(long runSeed, int generation, int number) {
        return startOf(of(of(runSeed, generation), number));
    }

    /**
     * A start that no generation of any run has: what is reported of a winner comes from such.
     *
     * @param number from 0
     */
    public static int freshStart(long runSeed, int number) {
        return 1 << START_BITS | startOf(of(~runSeed, number));
    }

    private static int startOf(long seed) {
        return (int) (seed >>> Long.SIZE - START_BITS);
    }
}
