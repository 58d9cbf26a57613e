package io.natator.evolution;

/** Seeds for the parts of a run, mixed as in SplitMix64 (Steele, Lea, Flood 2014). */
final class Seeds {

    private static final long GOLDEN_RATIO = 0x9E3779B97F4A7C15L;

    private Seeds() {
    }

    /** The seed of the part with this number, from 0. */
    static long of(long runSeed, int part) {
        long z = runSeed + (part + 1) * GOLDEN_RATIO;
        z = (z ^ (z >>> 30)) * 0xBF58476D1CE4E5B9L;
        z = (z ^ (z >>> 27)) * 0x94D049BB133111EBL;
        return z ^ (z >>> 31);
    }
}
