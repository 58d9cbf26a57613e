package io.natator.cli;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.cli.Section.Topic;
import io.natator.config.InvalidInputException;
import io.natator.config.Json;
import io.natator.config.Scheme;
import java.nio.file.Files;
import java.nio.file.Path;
import picocli.CommandLine.Option;

/** Options that change what is simulated. */
@Section(Topic.SCENE)
final class SceneOptions {

    @Option(names = "--scheme", paramLabel = "SCHEME",
            description = "How to solve: flex or conserving. Default: the scene's.")
    private Scheme scheme;

    @Option(names = "--duration", paramLabel = "SECONDS",
            description = "Simulated time. Default: the scene's (4 for the thesis scenes).")
    private Double duration;

    @Option(names = "--overrides", paramLabel = "JSON|FILE",
            description = "JSON Merge Patch on the scene: an object, or a file that holds one.")
    private String overrides;

    Scheme scheme() {
        return scheme;
    }

    Double duration() {
        return duration;
    }

    /** The merge patch, or null. */
    ObjectNode overrides() {
        if (overrides == null) {
            return null;
        }
        if (!overrides.stripLeading().startsWith("{")) {
            return Json.read(Path.of(overrides), ObjectNode.class, "--overrides");
        }
        try {
            return Json.parse(overrides, ObjectNode.class);
        } catch (JsonProcessingException e) {
            throw new InvalidInputException("--overrides: " + Json.reason(e), e);
        }
    }

    /** The scene as the simulator is to find it from any working directory: files by their absolute path. */
    static String scene(String given) {
        if (!given.endsWith(".json")) {
            return given;
        }
        Path file = Path.of(given);
        if (!Files.isRegularFile(file)) {
            throw new InvalidInputException("--scene is " + given + "; expected a named scene or an existing file");
        }
        return file.toAbsolutePath().normalize().toString();
    }
}
