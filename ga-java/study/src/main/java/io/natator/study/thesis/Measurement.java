package io.natator.study.thesis;

import com.fasterxml.jackson.annotation.JsonProperty;
import io.natator.config.Backend;
import io.natator.simulator.SimulationRequest;
import io.natator.simulator.SimulationResult;

/**
 * One measured evaluation, a line of {@code measurements.jsonl}.
 *
 * @param program SHA-256 of the native program that made it
 * @param backend what it computed on
 * @param request what was asked; its id is 0
 * @param result  what came out
 */
record Measurement(@JsonProperty(required = true) String program, @JsonProperty(required = true) Backend backend,
        @JsonProperty(required = true) SimulationRequest request,
        @JsonProperty(required = true) SimulationResult result) implements RequestLog.Answer {
}
