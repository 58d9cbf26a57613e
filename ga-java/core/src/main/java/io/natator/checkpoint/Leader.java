package io.natator.checkpoint;

import java.util.List;

/**
 * The gait that a run would have taken for its winner from an evaluation on, until another leads or more runs
 * change what it is worth. By all gaits that were ever run: the run itself forgets those that are neither among the best nor
 * in the population, so that now and then its winner is another one of nearly the same worth.
 *
 * @param evaluation number of the evaluation, from 0
 * @param simulated  time simulated until then, in seconds; null where the time of a whole run is not recorded
 * @param genes      of the gait, in the order of the encoding
 * @param worth      its worth by all its runs so far; negative for what goes backwards, or an objective that is a cost
 */
public record Leader(int evaluation, Double simulated, List<Double> genes, double worth) {
}
