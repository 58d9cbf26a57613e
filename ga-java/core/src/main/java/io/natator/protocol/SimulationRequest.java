package io.natator.protocol;

import com.fasterxml.jackson.annotation.JsonInclude;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.base.MergePatch;
import io.natator.body.Swimmer;
import io.natator.config.EvolutionSettings;
import io.natator.config.Scheme;
import io.natator.encoding.Gait;
import io.soabase.recordbuilder.core.RecordBuilder;

/**
 * What to simulate; the JSON form is {@code sim-native/protocol/request.schema.json}.
 *
 * @param id           repeated in the result, at least 0
 * @param scene        named scene or path of a scene file
 * @param gait         how the muscles move, or null for a scene without actuators
 * @param duration     simulated time in seconds, or null for the scene's own
 * @param scheme       or null for the scene's own
 * @param overrides    JSON Merge Patch on the scene, or null
 * @param start        which of many starts, at least 0, or null for the scene's own
 */
@JsonInclude(JsonInclude.Include.NON_NULL)
@RecordBuilder
public record SimulationRequest(long id, String scene, Gait gait, Double duration, Scheme scheme,
        JsonNode overrides, Integer start)
        implements SimulationRequestBuilder.With {

    /** A request from the scene's own start. */
    public SimulationRequest(long id, String scene, Gait gait, Double duration, Scheme scheme, JsonNode overrides) {
        this(id, scene, gait, duration, scheme, overrides, null);
    }

    /** A gait in a scene as it is, or null where nothing has muscles. */
    public static SimulationRequest of(String scene, Gait gait) {
        return new SimulationRequest(0, scene, gait, null, null, null);
    }

    /**
     * What a run asks of a swimmer, from the scene's own start.
     *
     * @param settings of the run
     */
    public static SimulationRequest of(long id, EvolutionSettings settings, Swimmer swimmer) {
        return new SimulationRequest(id, settings.problem().scene(), swimmer.gait(), settings.problem().duration(),
                settings.problem().scheme(), MergePatch.both(settings.problem().overrides(), swimmer.body()));
    }

    /** This request in a scene that is changed further; null for no change. */
    public SimulationRequest withChange(JsonNode change) {
        return withOverrides(MergePatch.both(overrides, change));
    }

    /** This request without early stops: neither a wall nor lack of progress ends it. Arriving at a goal that stops still does. */
    public SimulationRequest withoutStops() {
        ObjectNode patch = JsonNodeFactory.instance.objectNode();
        patch.putObject("stopping").put("planeContact", false).put("noProgressAfter", 0);
        return withChange(patch);
    }

    /**
     * This request without fluid, gravity and planes, as the thesis' check takes them out of a scene (2.7): a gait that advances
     * there is no swimming. It has no early stops, see {@link #withoutStops()}.
     *
     * @param seconds simulated time, or null for the scene's own
     */
    public SimulationRequest inVacuum(Double seconds) {
        ObjectNode removal = JsonNodeFactory.instance.objectNode();
        removal.putNull("fluid").putArray("planes");
        removal.putObject("solver").putArray("gravity").add(0).add(0).add(0);
        return withDuration(seconds).withChange(removal).withoutStops();
    }
}
