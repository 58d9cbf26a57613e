package io.natator.view;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.NullNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.base.InvalidInputException;
import io.natator.config.Json;
import java.util.Set;
import java.util.regex.Pattern;

/**
 * A command of a page, which the simulator is to get as it is; only that it names no file and no option is checked here.
 *
 * @param what    its {@code do}
 * @param content the whole command
 */
record ClientCommand(String what, ObjectNode content) {

    /** What comes first and starts a simulator; the only command that is for the server. */
    static final String START = "start";
    private static final String FILE_ENDING = ".json";
    /** A name without a folder. */
    private static final Pattern MESH = Pattern.compile("\\w[\\w-]*+\\.\\w++");
    /** Nothing is tried twice (possessive quantifiers), so that a long name takes no stack. */
    private static final Pattern NAME = Pattern.compile("\\w[\\w-]*+(?:/\\w[\\w-]*+)*+");

    /**
     * Reads the text.
     *
     * @throws InvalidInputException if it is no command: what, where and what was expected
     */
    static ClientCommand read(String text) {
        JsonNode node;
        try {
            node = Json.parse(text, JsonNode.class);
        } catch (JsonProcessingException e) {
            throw new InvalidInputException("command: " + Json.reason(e), e);
        }
        if (!(node instanceof ObjectNode content) || !content.path("do").isTextual()) {
            throw new InvalidInputException("command: expected an object with a text \"do\"");
        }
        return new ClientCommand(content.get("do").textValue(), content);
    }

    /** The {@code id} that its answer is to have; a null node without one that is a whole number. */
    JsonNode id() {
        return content.path("id").isIntegralNumber() ? content.get("id") : NullNode.getInstance();
    }

    /** The scene that it names, or null. */
    String scene() {
        return content.path("scene").textValue();
    }

    /** An object in it, or null where it is absent or null. */
    ObjectNode object(String key) {
        return content.get(key) instanceof ObjectNode object ? object : null;
    }

    /** Whether it asks for a flag among its options. */
    boolean option(String name) {
        return content.path("options").path(name).asBoolean(false);
    }

    /**
     * Refuses what would read other files than those that the user named when starting the server.
     *
     * @param files scenes and creatures that may be used though they are files
     * @throws InvalidInputException saying what is refused
     */
    void check(Set<String> files) {
        if (what.equals(START) || content.has("scene")) {
            String scene = scene();
            if (scene == null || !NAME.matcher(scene).matches() && !files.contains(scene)) {
                throw new InvalidInputException(
                        "scene: expected a named scene or one that the server was started with");
            }
        }
        for (String key : new String[] {"gait", "overrides"}) {
            if (content.hasNonNull(key) && object(key) == null) {
                throw new InvalidInputException(key + ": expected an object");
            }
        }
        content.properties().forEach(entry -> check(entry.getValue(), entry.getKey(), files));
    }

    /** Checks every part of a scene: creature, companions, obstacles, and what scenes will have in future. */
    private static void check(JsonNode node, String where, Set<String> files) {
        if (node.isArray()) {
            for (int i = 0; i < node.size(); i++) {
                check(node.get(i), where + "[" + i + "]", files);
            }
        }
        node.properties().forEach(entry -> check(entry.getValue(), where + "." + entry.getKey(), files));
        if (!node.isTextual()) {
            return;
        }
        String text = node.textValue();
        if (where.endsWith(".file") && !MESH.matcher(text).matches() && !files.contains(text)) {
            throw new InvalidInputException(where + ": expected a bundled mesh");
        }
        if (text.endsWith(FILE_ENDING) && !files.contains(text)) {
            throw new InvalidInputException(
                    where + ": expected a named " + (where.endsWith("creature.name") ? "creature" : "one")
                            + ", no file");
        }
    }
}
