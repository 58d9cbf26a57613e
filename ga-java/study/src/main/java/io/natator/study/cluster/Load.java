package io.natator.study.cluster;

/**
 * What a cluster has to do.
 *
 * @param evaluations  of a generation: gaits × starts
 * @param runsAtOnce   evolutions under way side by side, which share the executors evenly
 * @param generations  of each
 */
public record Load(int evaluations, int runsAtOnce, int generations) {
}
