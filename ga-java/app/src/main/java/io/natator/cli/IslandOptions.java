package io.natator.cli;

import io.natator.checkpoint.Archipelago;
import io.natator.cli.Section.Topic;
import io.natator.config.EvolutionSettings;
import io.natator.config.InvalidInputException;
import io.natator.config.Limits;
import picocli.CommandLine.Option;

/** Options of an evolution on several islands. */
@Section(Topic.SEARCH)
final class IslandOptions {

    private static final int EVERY = 5;
    /** The migrants are one of so many of the population. */
    private static final int SHARE = 20;

    @Option(names = "--islands", paramLabel = "N", defaultValue = "1", description = "Evolve so many populations at once, from 1, "
            + "each with a seed of its own from --seed on, which exchange their best gaits in a ring. Default: ${DEFAULT-VALUE}.")
    private int islands;

    @Option(names = "--migrate-every", paramLabel = "N", description = "Generations from one exchange of the islands to the next, "
            + "from 1. Default: " + EVERY + ", or half of the generations if these are fewer than " + 2 * EVERY + ".")
    private Integer every;

    @Option(names = "--migrants", paramLabel = "N", description = "Best gaits of each island that take the places of the worst of "
            + "the next one, fewer than the population; 0: none are exchanged. Default: a twentieth of the population.")
    private Integer migrants;

    /** What is to be evolved together; null for a run by itself. */
    Archipelago.Plan plan(EvolutionSettings settings) {
        Limits.checkCount("--islands", islands, Limits.AT_ONCE);
        if (islands == 1) {
            if (every != null || migrants != null) {
                throw new InvalidInputException((every != null ? "--migrate-every" : "--migrants")
                        + " is for several islands; expected --islands with it, from 2");
            }
            return null;
        }
        checkLeast("--migrate-every", every, 1);
        checkLeast("--migrants", migrants, 0);
        int usual = settings.generations() < 2 * EVERY ? Math.max(1, settings.generations() / 2) : EVERY;
        return new Archipelago.Plan(settings, islands, every != null ? every : usual,
                migrants != null ? migrants : Math.max(1, settings.population() / SHARE));
    }

    private static void checkLeast(String name, Integer value, int least) {
        if (value != null && value < least) {
            throw new InvalidInputException(name + " is " + value + "; expected a whole number from " + least);
        }
    }
}
