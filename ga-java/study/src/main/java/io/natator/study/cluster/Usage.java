package io.natator.study.cluster;

/**
 * What came of a simulation.
 *
 * @param seconds    from the beginning to the end of the last run
 * @param efficiency share of all the executors' time that went into evaluations which counted, at the speed of an
 *                   executor that is not slow
 * @param lost       evaluations that failed with their executor, and were done again
 * @param copies     evaluations that were begun a second time because they were slow
 */
public record Usage(double seconds, double efficiency, long lost, long copies) {
}
