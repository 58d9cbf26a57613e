package io.natator.evolution;

/**
 * Numbers of the simulator's starts. All gaits of a generation begin from the same ones, so that they are compared
 * under the same conditions; every generation has its own.
 */
public final class StartSeeds {

    /** The simulator takes 31 bits; the uppermost tells the fresh ones. */
    private static final int BITS = 30;

    private StartSeeds() {
    }

    /**
     * A start of a generation.
     *
     * @param runSeed seed of the run
     * @param number  from 0
     */
    static int of(long runSeed, int generation, int number) {
        return bits(Seeds.of(Seeds.of(runSeed, generation), number));
    }

    /**
     * A start that no generation of any run has: what is reported of a winner comes from such.
     *
     * @param runSeed seed of the run
     * @param number  from 0
     */
    public static int fresh(long runSeed, int number) {
        return 1 << BITS | bits(Seeds.of(~runSeed, number));
    }

    private static int bits(long seed) {
        return (int) (seed >>> Long.SIZE - BITS);
    }
}
