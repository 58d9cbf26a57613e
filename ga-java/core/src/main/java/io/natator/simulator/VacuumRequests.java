package io.natator.simulator;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.MergePatch;

/**
 * Takes fluid, gravity and planes out of any scene, as the thesis' check does (2.7): a gait that advances there is no
 * swimming.
 */
public final class VacuumRequests {

    private VacuumRequests() {
    }

    /**
     * The same gait without water.
     *
     * @param duration simulated time in seconds, or null for the scene's own; nothing but a goal that is reached stops it early
     */
    public static SimulationRequest of(SimulationRequest request, Double duration) {
        return new SimulationRequest(request.id(), request.scene(), request.gait(), duration, request.scheme(),
                patch(request.overrides()), request.perturbation(), request.start());
    }

    /** The merge patch that does first what the given one does, or nothing for null, and then removes the water. */
    private static JsonNode patch(JsonNode first) {
        JsonNodeFactory nodes = JsonNodeFactory.instance;
        ObjectNode removal = nodes.objectNode();
        removal.putNull("fluid").putArray("planes");
        removal.putObject("solver").putArray("gravity").add(0).add(0).add(0);
        removal.putObject("stopping").put("planeContact", false).put("noProgressAfter", 0);
        return MergePatch.both(first, removal);
    }
}
