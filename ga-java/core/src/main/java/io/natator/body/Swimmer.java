package io.natator.body;

import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.databind.JsonNode;
import io.natator.encoding.Gait;

/**
 * What swims: a gait, and a body if that is not the scene's.
 *
 * @param gait how its muscles move
 * @param body JSON Merge Patch that gives the scene its body, or null for the scene's own
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
public record Swimmer(Gait gait, JsonNode body) {

    /** Another gait of the same body. */
    public Swimmer withGait(Gait other) {
        return new Swimmer(other, body);
    }
}
