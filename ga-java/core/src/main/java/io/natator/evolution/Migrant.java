package io.natator.evolution;

/**
 * A gait that goes from one island to the next.
 *
 * @param born       number of the island that it was evaluated on, from 1
 * @param individual with its evaluation, whose id is that island's
 */
public record Migrant(int born, Individual individual) {
}
