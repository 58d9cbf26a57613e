package io.natator.config;

/**
 * How a run exchanges gaits with others in a ring: after every so many generations its best go to the next island, and those
 * of the island before it take the places of its worst.
 *
 * @param islands  how many there are, from 2 to {@link Limits#AT_ONCE}
 * @param island   which of them this run is, from 1
 * @param every    generations from one exchange to the next, from 1
 * @param migrants gaits that go to the next island each time, from 1 to fewer than the population
 */
public record Migration(int islands, int island, int every, int migrants) {

    /**
     * Checks the ranges.
     *
     * @throws InvalidInputException naming the setting that is out of range
     */
    public Migration {
        checkIslands(islands);
        if (island < 1 || island > islands) {
            throw new InvalidInputException("island is " + island + "; expected a whole number from 1 to " + islands);
        }
        if (every < 1) {
            throw new InvalidInputException("generations between exchanges are " + every + "; expected a whole number from 1");
        }
        Limits.checkCount("migrants", migrants, Limits.POPULATION);
    }

    /**
     * Checks how many islands there are.
     *
     * @throws InvalidInputException if they are fewer than 2 or more than {@link Limits#AT_ONCE}
     */
    public static void checkIslands(int islands) {
        if (islands < 2 || islands > Limits.AT_ONCE) {
            throw new InvalidInputException("islands are " + islands + "; expected a whole number from 2 to " + Limits.AT_ONCE);
        }
    }

    /** Refuses what a run with this optimizer and population cannot do. */
    void check(OptimizerKind optimizer, int population) {
        if (migrants >= population) {
            throw new InvalidInputException("migrants are " + migrants + "; expected fewer than the population, " + population);
        }
        // CMA-ES here learns from points that it proposed itself; random search from none; the others have no best and worst.
        if (optimizer != OptimizerKind.JGAP) {
            throw new InvalidInputException("optimizer " + Json.name(optimizer) + " takes no migrants; expected jgap, or islands "
                    + "without migrants");
        }
    }

    /** Number of the island whose gaits come to this one. */
    public int before() {
        return before(island, islands);
    }

    /** Number of the island before one in a ring of so many, from 1. */
    public static int before(int island, int islands) {
        return island == 1 ? islands : island - 1;
    }

    /** Whether gaits are exchanged after a generation. */
    public boolean isAfter(int generation) {
        return generation > 0 && generation % every == 0;
    }
}
