package io.natator.base;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

/** JSON Merge Patches (RFC 7386), as overrides of scenes are. */
public final class MergePatch {

    private MergePatch() {
    }

    /** One patch that does what both do one after the other; either may be null for nothing. */
    public static JsonNode both(JsonNode first, JsonNode second) {
        if (second == null || !(first instanceof ObjectNode before)) {
            return second == null ? first : second;
        }
        ObjectNode both = before.deepCopy();
        second.properties().forEach(entry -> both.set(entry.getKey(),
                entry.getValue().isObject() ? both(both.get(entry.getKey()), entry.getValue()) : entry.getValue()));
        return both;
    }
}
