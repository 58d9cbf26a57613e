package io.natator.cli;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.base.InvalidInputException;
import io.natator.cli.Section.Topic;
import io.natator.config.Json;
import io.natator.config.Scheme;
import java.nio.file.Files;
import java.nio.file.Path;
import picocli.CommandLine.Option;

/** Options that change a scene. */
@Section(Topic.SCENE)
class SceneChanges {

    @Option(names = "--scheme", paramLabel = "SCHEME",
            description = "How to solve: flex, conserving or lattice. Default: the run's, else the scene's.")
    private Scheme scheme;

    @Option(names = "--overrides", paramLabel = "JSON|FILE",
            description = "JSON Merge Patch on the scene: an object, or a file that holds one.")
    private String overrides;

    Scheme scheme() {
        return scheme;
    }

    /** The merge patch, or null. */
    ObjectNode overrides() {
        if (overrides == null) {
            return null;
        }
        if (isOtherJson(overrides)) {
            throw new InvalidInputException(
                    "--overrides is " + overrides.strip() + "; expected a JSON object, or a file that holds one");
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

    /** Whether a text that names no file is meant as JSON, but as no object: a list or a text, also a broken one, or a single value. */
    private static boolean isOtherJson(String text) {
        return text.strip().matches("(?s)[\\[\"].*|-?\\d[\\d.eE+-]*|true|false|null") && !Files.exists(Path.of(text));
    }
}
