package io.natator.spark;

import io.natator.protocol.SimulationResult;
import java.util.List;

/**
 * What an executor says of a part; crosses the wire as JSON.
 *
 * @param seconds that it took there
 * @param results of its requests, in their order; up to the first that the program refused
 */
record PartitionResponse(double seconds, List<SimulationResult> results) {
}
