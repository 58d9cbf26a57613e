package io.natator.checkpoint;

import io.natator.body.Swimmer;
import java.util.List;

/**
 * A gait and what it is worth by all its runs.
 *
 * @param genes      in the order of the encoding
 * @param swimmer    what they stand for
 * @param generation that it first swam in
 * @param score      its worth, as the run judges
 * @param runs       how many runs that rests on
 */
public record GaitScore(List<Double> genes, Swimmer swimmer, int generation, double score, int runs) {
}
