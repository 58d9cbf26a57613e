package io.natator.cli;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import io.natator.config.InvalidInputException;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import java.nio.file.Path;

/** A gait that the user names by a file. */
final class GaitFile {

    private GaitFile() {
    }

    /**
     * The gait in a file, or the one under its key {@code gait}, as in a run's {@code best.json}.
     *
     * @throws InvalidInputException if there is none
     */
    static Gait read(Path file) {
        JsonNode content = Json.read(file, JsonNode.class, "--gait");
        try {
            return Json.parse((content.has("gait") ? content.get("gait") : content).toString(), Gait.class);
        } catch (JsonProcessingException e) {
            throw new InvalidInputException("--gait " + file + ": " + Json.reason(e), e);
        }
    }
}
