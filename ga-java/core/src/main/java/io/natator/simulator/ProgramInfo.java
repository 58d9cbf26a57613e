package io.natator.simulator;

import com.fasterxml.jackson.annotation.JsonIgnoreProperties;
import com.fasterxml.jackson.annotation.JsonProperty;
import com.fasterxml.jackson.core.JsonProcessingException;
import io.natator.config.InvalidInputException;
import io.natator.config.Json;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;

/**
 * What the simulator says about itself ({@code natator-sim info --json}).
 *
 * @param version        version of its source
 * @param commit         that it was built from, or {@code unknown}; null from a program that does not say
 * @param instructionSet kernels that it uses on this processor
 * @param devices        GPUs, by number
 * @param scenes         names of the scenes that come with it
 */
@JsonIgnoreProperties(ignoreUnknown = true)
public record ProgramInfo(@JsonProperty(required = true) String version, String commit,
        @JsonProperty(required = true) String instructionSet, @JsonProperty(required = true) List<String> devices,
        List<String> scenes) {

    /** Copies the scenes. */
    public ProgramInfo {
        scenes = scenes == null ? List.of() : List.copyOf(scenes);
    }

    private static final Duration TIMEOUT = Duration.ofSeconds(60);

    /**
     * Asks the simulator about itself.
     *
     * @throws InvalidInputException if it cannot be run, or says something else
     * @throws InterruptedException  if the calling thread is interrupted
     */
    public static ProgramInfo of(Path simulator) throws InterruptedException {
        try {
            return Json.parse(ask(simulator, List.of("info", "--json"), "itself"), ProgramInfo.class);
        } catch (JsonProcessingException e) {
            throw new InvalidInputException("simulator does not describe itself: " + Json.reason(e), e);
        }
    }

    /**
     * What {@code natator-sim info} writes.
     *
     * @param subject what is asked about, for the message
     * @throws InvalidInputException if it ends with another exit status than 0
     */
    static String ask(Path simulator, List<String> arguments, String subject) throws InterruptedException {
        try (NativeProgram program = new NativeProgram(simulator, TIMEOUT)) {
            NativeProgram.Output output = program.call(arguments, "");
            if (output.exitStatus() != 0) {
                throw new InvalidInputException(subject + ": " + (output.errorText().isEmpty()
                        ? "simulator ended with exit status " + output.exitStatus() : output.errorText()));
            }
            return output.text();
        } catch (SimulatorFailure e) {
            throw new InvalidInputException("simulator does not describe " + subject + ": " + e.getMessage(), e);
        }
    }
}
