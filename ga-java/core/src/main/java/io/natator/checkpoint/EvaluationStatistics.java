package io.natator.checkpoint;

import com.fasterxml.jackson.annotation.JsonIgnoreProperties;

/**
 * What a run did not have to simulate; {@code savings.json}.
 *
 * @param evaluations      results of new chromosomes
 * @param unchanged        chromosomes that went on, or came out of breeding, as they were and were not evaluated again
 * @param fromCache        of the evaluations, those whose result an earlier evaluation had left in the cache
 * @param stoppedEarly     of the evaluations, those that ended before their time
 * @param simulatedSeconds time simulated in all evaluations, those from the cache included
 * @param wholeSeconds     the same, had none ended early
 * @param refused          of the evaluations, those of bodies that were not simulated
 */
@JsonIgnoreProperties(ignoreUnknown = true)
public record EvaluationStatistics(long evaluations, long unchanged, long fromCache, long stoppedEarly,
        double simulatedSeconds, double wholeSeconds, long refused) {

    /** Evaluations that were not refused, so that there was something to simulate. */
    public long simulations() {
        return evaluations - refused;
    }

    /** Simulated time of an evaluation that nothing ends early, in seconds; 0 without simulations. */
    public double duration() {
        return simulations() == 0 ? 0 : wholeSeconds / simulations();
    }

    /** Share of the simulated time that early stops saved; 0 without any, whatever sums of seconds round to. */
    public double shareOfEarlyStops() {
        return stoppedEarly > 0 && wholeSeconds > 0 ? Math.max(1 - simulatedSeconds / wholeSeconds, 0) : 0;
    }
}
