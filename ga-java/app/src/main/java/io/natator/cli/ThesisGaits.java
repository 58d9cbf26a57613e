package io.natator.cli;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.nio.charset.StandardCharsets;

/** The gaits that the thesis published, by which its creatures swim where nobody gives another. */
final class ThesisGaits {

    private ThesisGaits() {
    }

    /** The gait of the creature in one of the thesis' scenes, of several the last; null for any other scene. */
    static Gait in(String scene) {
        Gait found = null;
        try (InputStream in = ThesisGaits.class.getResourceAsStream("thesis.json")) {
            for (JsonNode one : Json.parse(new String(in.readAllBytes(), StandardCharsets.UTF_8), JsonNode.class)
                    .get("gaits")) {
                if (scene.replaceFirst("-vacuum$", "").equals("thesis/creature-" + one.get("creature").asInt())) {
                    found = Json.parse(one.get("gait").toString(), Gait.class);
                }
            }
        } catch (JsonProcessingException e) {
            throw new IllegalStateException("thesis.json: " + Json.reason(e), e);
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
        return found;
    }
}
