package io.natator.config;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import java.util.ArrayList;
import java.util.LinkedHashSet;
import java.util.List;
import java.util.Set;

/** How settings differ from others, in words. */
public final class SettingsChange {

    /** What may change while a run is under way: how far it goes, and what it computes on. */
    private static final Set<String> FREE = Set.of("generations", "evaluations", "backend");

    private SettingsChange() {
    }

    /** All that has changed: {@code seed was 5, is now 6; overrides.duration was not set, is now 2}. Empty if nothing has. */
    public static String between(EvolutionSettings before, EvolutionSettings now) {
        return between(before, now, Set.of());
    }

    /** All that has changed but what may change while a run is under way. */
    public static String withinRun(EvolutionSettings before, EvolutionSettings now) {
        return between(before, now, FREE);
    }

    private static String between(EvolutionSettings before, EvolutionSettings now, Set<String> free) {
        List<String> found = new ArrayList<>();
        add(found, "", ((ObjectNode) Json.tree(before)).remove(free), ((ObjectNode) Json.tree(now)).remove(free));
        return String.join("; ", found);
    }

    private static void add(List<String> found, String name, JsonNode before, JsonNode now) {
        if (before instanceof ObjectNode && now instanceof ObjectNode) {
            Set<String> keys = new LinkedHashSet<>();
            before.fieldNames().forEachRemaining(keys::add);
            now.fieldNames().forEachRemaining(keys::add);
            keys.forEach(key -> add(found, name.isEmpty() ? key : name + "." + key, before.path(key), now.path(key)));
        } else if (!before.equals(now)) {
            found.add(name + " was " + shown(before) + ", is now " + shown(now));
        }
    }

    private static String shown(JsonNode value) {
        return value.isMissingNode() ? "not set" : Json.shown(value);
    }
}
