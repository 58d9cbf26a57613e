package io.natator.view;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.Json;
import io.natator.config.Scheme;
import io.natator.encoding.Gait;

/**
 * What the page shows first.
 *
 * @param scene     name or path
 * @param overrides JSON Merge Patch on the scene, or null
 * @param gait      how the muscles move; null where they are to rest
 */
public record InitialScene(String scene, ObjectNode overrides, Gait gait) {

    /** A patch on a scene that also sets its scheme; either may be null, and the patch is if both are. */
    public static ObjectNode patch(JsonNode overrides, Scheme scheme) {
        if (overrides == null && scheme == null) {
            return null;
        }
        ObjectNode all = overrides == null ? JsonNodeFactory.instance.objectNode() : overrides.deepCopy();
        if (scheme != null) {
            all.put("scheme", Json.name(scheme));
        }
        return all;
    }
}
