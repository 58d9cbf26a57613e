package io.natator.evolution;

import java.util.List;

/**
 * The gaits that left an island after a generation; one line of {@code migrants.jsonl}.
 *
 * @param generation after which
 * @param migrants   the best first
 */
public record Departure(int generation, List<Migrant> migrants) {

    /** Copies the list. */
    public Departure {
        migrants = List.copyOf(migrants);
    }
}
