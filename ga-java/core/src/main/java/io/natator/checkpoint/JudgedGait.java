package io.natator.checkpoint;

import io.natator.encoding.Gait;

/**
 * A gait and what it is worth by all its runs.
 *
 * @param gait       how it swims
 * @param generation that it first swam in
 * @param score      its worth, as the run judges
 * @param runs       how many runs that rests on
 */
public record JudgedGait(Gait gait, int generation, double score, int runs) {
}
