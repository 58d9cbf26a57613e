package io.natator.simulator;

import com.fasterxml.jackson.annotation.JsonIgnoreProperties;
import com.fasterxml.jackson.annotation.JsonProperty;
import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.config.ExecutionSettings;
import io.natator.config.InvalidInputException;
import io.natator.config.Json;
import java.util.List;

/**
 * What the simulator says about a scene ({@code natator-sim info SCENE --json}).
 *
 * @param scene     the scene's name or path
 * @param actuators number of actuators of its creature; 0 without a creature
 */
@JsonIgnoreProperties(ignoreUnknown = true)
public record SceneInfo(String scene, @JsonProperty(required = true) int actuators) {

    /**
     * Asks the simulator about a scene.
     *
     * @throws InvalidInputException if the simulator does not know the scene, or cannot be run
     * @throws InterruptedException  if the calling thread is interrupted
     */
    public static SceneInfo of(String scene, ExecutionSettings settings) throws InterruptedException {
        NativeProgram.Output output;
        try (NativeProgram program = new NativeProgram(settings.simulator(), settings.timeout())) {
            output = program.call(List.of("info", scene, "--json"), "");
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
