package io.natator.process;

import com.fasterxml.jackson.annotation.JsonIgnoreProperties;
import com.fasterxml.jackson.annotation.JsonProperty;
import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import io.natator.base.InvalidInputException;
import io.natator.body.ProfileBody;
import io.natator.config.EncodingKind;
import io.natator.config.Json;
import io.natator.protocol.RequestRejectedException;
import java.nio.file.Path;
import java.util.ArrayList;
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
 * @param bodyLength head to tail at rest, in scene units; 0 without a creature, null from a program that does not say
 * @param bodyParticles particles of its creature; null likewise
 * @param goals      what its goals measure, or null where it has none
 */
@JsonIgnoreProperties(ignoreUnknown = true)
public record SceneInfo(@JsonProperty(required = true) String scene, @JsonProperty(required = true) int actuators,
        @JsonProperty(required = true) long particles, @JsonProperty(required = true) double duration,
        @JsonProperty(required = true) double timeStep, @JsonProperty(required = true) int substeps,
        @JsonProperty(required = true) int iterations, Double bodyLength, Integer bodyParticles, List<String> goals) {

    /** Copies the list. */
    public SceneInfo {
        goals = goals == null ? null : List.copyOf(goals);
    }

    /**
     * When a run ends that nothing ends early: after a whole number of frames, in seconds.
     *
     * @param asked duration in seconds, or null for the scene's own
     */
    public double end(Double asked) {
        double wanted = asked == null ? duration : asked;
        double end = Math.max(1, Math.round(wanted / timeStep)) * timeStep;
        return Math.abs(end - wanted) < timeStep / 1000 ? wanted : end;
    }

    /**
     * Asks the simulator about a scene.
     *
     * @param overrides JSON Merge Patch on the scene, or null
     * @param simulator the native program
     * @throws InvalidInputException    if the simulator does not know the scene
     * @throws RequestRejectedException if it cannot be run
     */
    public static SceneInfo of(String scene, JsonNode overrides, Path simulator) throws InterruptedException {
        String text = ask(scene, overrides, simulator);
        try {
            return Json.parse(text, SceneInfo.class);
        } catch (JsonProcessingException e) {
            throw new InvalidInputException("simulator does not describe scene " + scene + ": " + Json.reason(e), e);
        }
    }

    /**
     * Asks the simulator about a scene whose gaits are to be evolved.
     *
     * @throws InvalidInputException also if it has no actuators, or too few for the encoding
     */
    public static SceneInfo toEvolve(String scene, EncodingKind encoding, JsonNode overrides, Path simulator)
            throws InterruptedException {
        SceneInfo info = of(scene, overrides, simulator);
        if (info.actuators == 0) {
            throw new InvalidInputException(
                    "scene " + scene + " cannot move by itself: it has no actuators; expected a "
                            + "creature with at least two joints");
        }
        try {
            encoding.forActuators(info.actuators);
        } catch (IllegalArgumentException e) {
            throw new InvalidInputException("scene " + scene + ": " + e.getMessage(), e);
        }
        return info;
    }

    /**
     * The body of a scene's creature, to be evolved.
     *
     * @throws InvalidInputException also if that has no genes
     */
    public static ProfileBody bodyToEvolve(String scene, JsonNode overrides, Path simulator)
            throws InterruptedException {
        try {
            return ProfileBody.of(Json.parse(definition(scene, overrides, simulator), JsonNode.class).path("creature"));
        } catch (JsonProcessingException e) {
            throw new InvalidInputException("simulator does not define scene " + scene + ": " + Json.reason(e), e);
        } catch (InvalidInputException e) {
            throw new InvalidInputException("scene " + scene + ": " + e.getMessage(), e);
        }
    }

    /**
     * The name of a scene's creature; empty of a scene without one.
     *
     * @throws InvalidInputException if the simulator does not know the scene
     */
    public static String creature(String scene, Path simulator) throws InterruptedException {
        try {
            return Json.parse(definition(scene, null, simulator), JsonNode.class).at("/creature/name").asText();
        } catch (JsonProcessingException e) {
            throw new InvalidInputException("simulator does not define scene " + scene + ": " + Json.reason(e), e);
        }
    }

    /**
     * The scene itself as one line of JSON, with all that it builds on: what a simulation of it depends on, besides the
     * rest of the request and the program.
     *
     * @param overrides JSON Merge Patch on the scene, or null
     * @throws InvalidInputException    if the simulator does not know the scene
     * @throws RequestRejectedException if it cannot be run
     */
    public static String definition(String scene, JsonNode overrides, Path simulator) throws InterruptedException {
        return ask(scene, overrides, simulator, "--definition");
    }

    /**
     * A gait to begin with for the scene's muscles, as one line of JSON.
     *
     * @throws InvalidInputException also if it has no muscles
     */
    public static String gaitTemplate(String scene, Path simulator) throws InterruptedException {
        return ask(scene, null, simulator, "--gait-template");
    }

    private static String ask(String scene, JsonNode overrides, Path simulator, String... options)
            throws InterruptedException {
        List<String> arguments = new ArrayList<>(List.of("info", scene, "--json"));
        arguments.addAll(List.of(options));
        if (overrides != null) {
            arguments.addAll(List.of("--overrides", overrides.toString()));
        }
        return ProgramInfo.ask(simulator, arguments, "scene " + scene);
    }
}
