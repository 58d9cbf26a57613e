package io.natator.stream;

import com.fasterxml.jackson.annotation.JsonIgnoreProperties;
import com.fasterxml.jackson.annotation.JsonProperty;
import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.Json;
import java.util.List;

/**
 * What of a {@code SCEN} this side needs; pages read the message itself. All of it stays the same until the next one.
 *
 * @param protocol  {@value #PROTOCOL}
 * @param number    counts from 1
 * @param scene     name or path
 * @param overrides JSON Merge Patch on the scene, or null
 * @param gait      how the muscles move, or null
 * @param scheme    {@code flex}, {@code conserving} or {@code lattice}
 * @param precision {@code float} or {@code double}
 * @param definition the whole scene, bases and overrides merged, or null
 * @param timeStep  of a frame, s
 * @param fields    what frames hold, in this order
 * @param particles their number N
 * @param mass      of each particle; null for one that is held in place
 * @param fluid     first fluid particle and their number
 * @param actuators their number A; 0 = nearest the head
 */
@JsonIgnoreProperties(ignoreUnknown = true)
public record StreamScene(@JsonProperty(required = true) int protocol, @JsonProperty(required = true) long number,
        @JsonProperty(required = true) String scene, JsonNode overrides, JsonNode gait, String scheme, String precision,
        JsonNode definition, @JsonProperty(required = true) double timeStep,
        @JsonProperty(required = true) List<StreamField> fields,
        @JsonProperty(required = true) int particles, @JsonProperty(required = true) List<Double> mass,
        @JsonProperty(required = true) List<Integer> fluid, @JsonProperty(required = true) int actuators) {

    /** The version of the protocol that is read here. */
    public static final int PROTOCOL = 2;
    /** Keeps the size of a frame within what one array can hold. */
    static final int MAX_PARTICLES = 10_000_000;
    static final int MAX_ACTUATORS = 100_000;

    /** A JSON null counts as absent. */
    public StreamScene {
        overrides = present(overrides);
        gait = present(gait);
    }

    /** Whether it is plane flow: its water is on a lattice one cell deep. */
    public boolean isPlane() {
        return "lattice".equals(scheme) && definition != null
                && definition.path("fluid").path("count").path(1).asInt() == 1;
    }

    private static JsonNode present(JsonNode node) {
        return node == null || node.isNull() ? null : node;
    }

    /**
     * Reads and checks a scene.
     *
     * @param body of its {@code SCEN}, with what those before it say where that one is short
     *
     * @throws StreamException if it is not JSON, lacks a key, or contradicts itself
     */
    static StreamScene of(ObjectNode body) throws StreamException {
        StreamScene scene;
        try {
            scene = Json.tree(body, StreamScene.class);
        } catch (JsonProcessingException e) {
            throw new StreamException("SCEN: " + Json.reason(e), e);
        }
        scene.check();
        return scene;
    }

    private void check() throws StreamException {
        expect(protocol == PROTOCOL, "protocol is " + protocol + "; expected " + PROTOCOL);
        expect(timeStep > 0 && Double.isFinite(timeStep), "timeStep is " + timeStep + "; expected seconds above 0");
        within("particles", particles, MAX_PARTICLES);
        within("actuators", actuators, MAX_ACTUATORS);
        expect(mass != null && mass.size() == particles, "mass has " + (mass == null ? 0 : mass.size())
                + " numbers; expected " + particles);
        expect(fields != null && fields.stream().distinct().sorted().toList().equals(fields),
                "fields are " + fields + "; expected some of position, velocity, density, force in this order");
        expect(fluid != null && fluid.size() == 2 && fluid.get(0) >= 0 && fluid.get(1) >= 0
                && fluid.get(0) + (long) fluid.get(1) <= particles,
                "fluid is " + fluid + "; expected [first, count] of at most " + particles + " particles");
    }

    private static void within(String key, int value, int limit) throws StreamException {
        expect(value >= 0 && value <= limit, key + " is " + value + "; expected 0 to " + limit);
    }

    private static void expect(boolean holds, String otherwise) throws StreamException {
        if (!holds) {
            throw new StreamException("SCEN: " + otherwise);
        }
    }

    /** Whether frames hold the field. */
    public boolean has(StreamField field) {
        return fields.contains(field);
    }

    /** First fluid particle. */
    public int firstFluid() {
        return fluid.get(0);
    }

    /** Number of fluid particles. */
    public int fluidCount() {
        return fluid.get(1);
    }

    /** Length of the body of a {@code FRAM}, bytes. */
    public int frameBytes() {
        int perParticle = fields.stream().mapToInt(StreamField::components).sum();
        return StreamFrame.HEAD_BYTES + Float.BYTES * (actuators + perParticle * particles);
    }
}
