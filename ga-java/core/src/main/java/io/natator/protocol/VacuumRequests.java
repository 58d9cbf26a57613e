package io.natator.protocol;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * Takes fluid, gravity and planes out of any scene, as the thesis' check does (2.7): a gait that advances there is no
 * swimming.
 */
public final class VacuumRequests {

    private VacuumRequests() {
    }

    /**
     * The request without water.
     *
     * @param duration simulated time in seconds, or null for the scene's own; it has no early stops, see
     *                 {@link SimulationRequest#withoutStops()}
     */
    public static SimulationRequest of(SimulationRequest request, Double duration) {
        ObjectNode removal = JsonNodeFactory.instance.objectNode();
        removal.putNull("fluid").putArray("planes");
        removal.putObject("solver").putArray("gravity").add(0).add(0).add(0);
        return request.withDuration(duration).withChange(removal).withoutStops();
    }
}
