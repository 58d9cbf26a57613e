package io.natator.checkpoint;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.base.InvalidInputException;
import io.natator.base.Sha256;
import io.natator.config.EvolutionSettings;
import io.natator.config.Json;
import io.natator.process.SceneInfo;
import java.nio.file.Path;
import java.util.Objects;

/** Digests by which a scene that was changed since a run was begun is noticed: it makes another experiment. */
public final class SceneDigest {

    private static final String WITHOUT_EFFECT = "description";

    private SceneDigest() {
    }

    /**
     * Digest of the scene of a run with all that it builds on and the run's overrides, but for descriptions.
     *
     * @param simulator the native program
     * @return SHA-256 in hexadecimal digits
     * @throws InvalidInputException                         if the simulator does not know the scene
     * @throws io.natator.protocol.RequestRejectedException if it cannot be run
     */
    public static String of(EvolutionSettings settings, Path simulator) throws InterruptedException {
        try {
            JsonNode scene = Json.parse(
                    SceneInfo.definition(settings.problem().scene(), settings.problem().overrides(), simulator),
                    JsonNode.class);
            scene.findParents(WITHOUT_EFFECT).forEach(part -> ((ObjectNode) part).remove(WITHOUT_EFFECT));
            return Sha256.of(Json.line(scene));
        } catch (JsonProcessingException e) {
            throw new InvalidInputException(
                    "simulator does not define scene " + settings.problem().scene() + ": " + Json.reason(e), e);
        }
    }

    /**
     * Refuses to go on with a run whose scene was changed.
     *
     * @param directory of the run; one that recorded no digest goes on with any scene
     * @param settings  that it is to go on with; another scene or other overrides are not checked here
     * @param digest    of their scene as it is now
     * @throws InvalidInputException that says which scene
     */
    public static void check(Path directory, EvolutionSettings settings, String digest) {
        RunReader.Origin origin = RunReader.origin(directory);
        if (isWith(origin, settings)) {
            check(directory, origin, digest);
        }
    }

    /**
     * Refuses to go on with a run whose scene was changed; the digest is worked out only where it can tell.
     *
     * @param simulator the native program
     */
    static void check(Path directory, EvolutionSettings settings, Path simulator) throws InterruptedException {
        RunReader.Origin origin = RunReader.origin(directory);
        if (isWith(origin, settings)) {
            check(directory, origin, of(settings, simulator));
        }
    }

    private static void check(Path directory, RunReader.Origin origin, String digest) {
        if (!origin.sceneSha256().equals(digest)) {
            throw new InvalidInputException(
                    "scene " + origin.settings().problem().scene() + " was changed after " + directory
                            + " was begun; expected the scene that it was begun with, or a new run");
        }
    }

    /** Whether it is known what these settings' scene was when the run was begun. */
    private static boolean isWith(RunReader.Origin origin, EvolutionSettings settings) {
        return origin != null && origin.sceneSha256() != null && origin.settings() != null
                && origin.settings().problem().scene().equals(settings.problem().scene())
                && Objects.equals(origin.settings().problem().overrides(), settings.problem().overrides());
    }
}
