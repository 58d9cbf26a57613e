package io.natator.checkpoint;

import io.natator.encoding.Gait;
import java.util.List;

/**
 * A gait and what it is worth by all its runs.
 *
 * @param genes      in the order of the encoding
 * @param gait       how it swims
 * @param generation that it first swam in
 * @param score      its worth, as the run judges
 * @param runs       how many runs that rests on
 */
public record JudgedGait(List<Double> genes, Gait gait, int generation, double score, int runs) {
}
