package io.natator.cli;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.body.Swimmer;
import io.natator.config.InvalidInputException;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import java.nio.file.Path;

/** A gait that the user names by a file, and the body that a run's {@code best.json} has beside it. */
final class GaitFile {

    private GaitFile() {
    }

    /**
     * The gait in a file; or the one under its key {@code gait} and the body under {@code body}, as in a run's
     * {@code best.json}. A {@code $schema} that names its schema for editors is ignored.
     *
     * @throws InvalidInputException if there is none
     */
    static Swimmer read(Path file) {
        JsonNode content = Json.read(file, JsonNode.class, "--gait");
        JsonNode body = content.get("body");
        if (body != null && !body.isObject()) {
            throw new InvalidInputException("--gait " + file + ": body is " + body + "; expected a JSON Merge Patch on the scene");
        }
        JsonNode gait = content.has("gait") ? content.get("gait") : content;
        if (gait instanceof ObjectNode keys) {
            keys.remove("$schema");
        }
        try {
            return new Swimmer(Json.tree(gait, Gait.class), body);
        } catch (JsonProcessingException e) {
            throw new InvalidInputException("--gait " + file + ": " + Json.reason(e), e);
        }
    }
}
