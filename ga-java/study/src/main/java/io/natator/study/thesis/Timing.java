package io.natator.study.thesis;

import com.fasterxml.jackson.annotation.JsonProperty;
import io.natator.simulator.SimulationRequest;

/**
 * What a simulated second costs; a line of {@code costs.jsonl}.
 *
 * @param program SHA-256 of the native program
 * @param machine processor architecture and instruction set
 * @param request what was timed; its id is 0
 * @param seconds of one core for a simulated second, the least of several trials
 */
record Timing(@JsonProperty(required = true) String program, @JsonProperty(required = true) String machine,
        @JsonProperty(required = true) SimulationRequest request, @JsonProperty(required = true) double seconds) {
}
