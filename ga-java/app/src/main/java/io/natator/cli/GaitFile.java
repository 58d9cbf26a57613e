package io.natator.cli;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.base.InvalidInputException;
import io.natator.body.Swimmer;
import io.natator.config.Json;
import io.natator.encoding.Gait;
import java.lang.reflect.RecordComponent;
import java.nio.file.Path;
import java.util.Arrays;
import java.util.List;
import java.util.Map;

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
            throw new InvalidInputException(
                    "--gait " + file + ": body is " + body + "; expected a JSON Merge Patch on the scene");
        }
        JsonNode gait = content.has("gait") ? content.get("gait") : content;
        if (!(gait instanceof ObjectNode keys)) {
            throw new InvalidInputException("--gait " + file + ": gait is " + Json.shown(gait)
                    + "; expected an object with frequency, amplitude and phase");
        }
        keys.remove("$schema");
        requireKnown(file, keys);
        requireNumbers(file, "", gait);
        try {
            return new Swimmer(Json.tree(gait, Gait.class), body);
        } catch (JsonProcessingException e) {
            throw new InvalidInputException("--gait " + file + ": " + Json.reason(e), e);
        }
    }

    /** Before values are looked at, which of an unknown key can be anything. */
    private static void requireKnown(Path file, ObjectNode gait) {
        List<String> known = Arrays.stream(Gait.class.getRecordComponents()).map(RecordComponent::getName).toList();
        gait.properties().stream().map(Map.Entry::getKey).filter(key -> !known.contains(key)).findFirst()
                .ifPresent(key -> {
                    throw new InvalidInputException("--gait " + file + ": " + key
                            + ": unknown key; expected some of " + String.join(", ", known));
                });
    }

    /** A gait has numbers only, in lists or not: no text that looks like one, and no null for what can be left out. */
    private static void requireNumbers(Path file, String place, JsonNode node) {
        if (node.isObject()) {
            node.properties().forEach(
                    one -> requireNumbers(file, place + (place.isEmpty() ? "" : ".") + one.getKey(), one.getValue()));
        } else if (node.isArray()) {
            for (int i = 0; i < node.size(); i++) {
                requireNumbers(file, place + "[" + i + "]", node.get(i));
            }
        } else if (!node.isNumber()) {
            throw new InvalidInputException(
                    "--gait " + file + ": " + place + " is " + Json.shown(node) + "; expected a number");
        }
    }
}
