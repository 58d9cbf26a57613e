package io.natator.simulator;

import com.fasterxml.jackson.annotation.JsonIgnoreProperties;
import com.fasterxml.jackson.annotation.JsonProperty;
import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import io.natator.config.InvalidInputException;
import io.natator.config.Json;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;

/**
 * What the simulator says about a scene ({@code natator-sim info SCENE --json}).
 *
 * @param scene      the scene's name or path
 * @param actuators  number of actuators of its creature; 0 without a creature
 * @param particles  of body and fluid together
 * @param duration   simulated time in seconds
 * @param timeStep   of a frame, in seconds
 * @param substeps   of a frame
 * @param iterations of a substep
 */
@JsonIgnoreProperties(ignoreUnknown = true)
public record SceneInfo(@JsonProperty(required = true) String scene, @JsonProperty(required = true) int actuators,
        @JsonProperty(required = true) long particles, @JsonProperty(required = true) double duration,
        @JsonProperty(required = true) double timeStep, @JsonProperty(required = true) int substeps,
        @JsonProperty(required = true) int iterations) {

    private static final Duration TIMEOUT = Duration.ofSeconds(60);

    /**
     * Asks the simulator about a scene.
     *
     * @param overrides JSON Merge Patch on the scene, or null
     * @param simulator the native program
     * @throws InvalidInputException if the simulator does not know the scene, or cannot be run
     * @throws InterruptedException  if the calling thread is interrupted
     */
    public static SceneInfo of(String scene, JsonNode overrides, Path simulator) throws InterruptedException {
        List<String> arguments = overrides == null ? List.of("info", scene, "--json")
                : List.of("info", scene, "--json", "--overrides", overrides.toString());
        NativeProgram.Output output;
        try (NativeProgram program = new NativeProgram(simulator, TIMEOUT)) {
            output = program.call(arguments, "");
        } catch (SimulatorFailure e) {
            throw new InvalidInputException("simulator does not describe scene " + scene + ": " + e.getMessage(), e);
        }
        if (output.exitStatus() != 0) {
            throw new InvalidInputException("scene " + scene + ": " + (output.errorText().isEmpty()
                    ? "simulator ended with exit status " + output.exitStatus() : output.errorText()));
        }
        try {
            return Json.parse(output.text(), SceneInfo.class);
        } catch (JsonProcessingException e) {
            throw new InvalidInputException("simulator does not describe scene " + scene + ": " + Json.reason(e), e);
        }
    }
}
