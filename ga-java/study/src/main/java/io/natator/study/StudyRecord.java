package io.natator.study;

import com.fasterxml.jackson.annotation.JsonProperty;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.SimulationResult;

/**
 * One finished evaluation, as kept in {@code evaluations.jsonl}.
 *
 * @param variant   name of the variant
 * @param simulator SHA-256 of the native program that made it
 */
record StudyRecord(@JsonProperty(required = true) String variant, @JsonProperty(required = true) String simulator,
        @JsonProperty(required = true) SimulationRequest request, @JsonProperty(required = true) SimulationResult result) {
}
