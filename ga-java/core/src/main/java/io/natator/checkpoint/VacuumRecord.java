package io.natator.checkpoint;

/**
 * A best gait that was also run in vacuum; a line of {@code vacuum.jsonl}.
 *
 * @param generation that found it
 * @param evaluation its number in the run
 * @param distance   signed distance swum in scene units
 * @param simulated  in this time, in seconds
 * @param drift      signed distance in vacuum in the same time; null if it could not be measured
 */
public record VacuumRecord(int generation, long evaluation, double distance, double simulated, Double drift) {
}
