package io.natator.stream;

import com.fasterxml.jackson.annotation.JsonIgnoreProperties;
import com.fasterxml.jackson.annotation.JsonProperty;
import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.Json;
import java.util.List;
import java.util.Map;

/**
 * A {@code SCEN}: all that stays the same until the next one. Lengths in the scene's unit.
 *
 * @param protocol          {@value #PROTOCOL}
 * @param program           version and instruction set of the simulator
 * @param number            counts from 1
 * @param restarted         whether the state is a fresh settled start
 * @param scene             name or path
 * @param overrides         JSON Merge Patch on the scene, or null
 * @param gait              how the muscles move, or null
 * @param scheme            {@code flex}, {@code conserving} or {@code lattice}
 * @param precision         {@code float} or {@code double}
 * @param definition        the whole scene, bases and overrides merged
 * @param timeStep          of a frame, s
 * @param duration          of an evaluation, s; a stream goes on past it
 * @param radius            of a particle's neighbourhood
 * @param solidRestDistance between a solid and any other particle
 * @param fluidRestDistance between fluid particles
 * @param planes            [nx, ny, nz, d] each, normal towards the inside
 * @param periodic          where the tank begins and ends along the axes, {@code x} or {@code z}, that it closes up with
 *                          itself along
 * @param fields            what frames hold, in this order
 * @param particles         their number N
 * @param mass              of each particle; null for one that is held in place
 * @param fluid             first fluid particle and their number
 * @param body              indices of the body's particles
 * @param slices            indices of each slice's particles, from the head on
 * @param bodyLength        head to tail at rest; 0 without a body
 * @param companions        the other bodies in the tank, in the scene's order
 * @param clusters          indices of each cluster's particles, from the head on, after the body's those of companions
 * @param joints            indices of the slices that are joints
 * @param actuators         their number A; 0 = nearest the head
 * @param muscles           springs that contract
 * @param skin              the mesh that the body was made of, or null
 */
@JsonIgnoreProperties(ignoreUnknown = true)
public record StreamScene(@JsonProperty(required = true) int protocol, JsonNode program,
        @JsonProperty(required = true) long number, @JsonProperty(required = true) boolean restarted,
        @JsonProperty(required = true) String scene, JsonNode overrides, JsonNode gait, String scheme, String precision,
        @JsonProperty(required = true) JsonNode definition, @JsonProperty(required = true) double timeStep,
        double duration, double radius, double solidRestDistance, double fluidRestDistance,
        @JsonProperty(required = true) List<List<Double>> planes, Map<String, List<Double>> periodic,
        @JsonProperty(required = true) List<StreamField> fields, @JsonProperty(required = true) int particles,
        @JsonProperty(required = true) List<Double> mass, @JsonProperty(required = true) List<Integer> fluid,
        @JsonProperty(required = true) List<Integer> body, @JsonProperty(required = true) List<List<Integer>> slices,
        double bodyLength, List<Companion> companions, @JsonProperty(required = true) List<List<Integer>> clusters,
        @JsonProperty(required = true) List<Integer> joints, @JsonProperty(required = true) int actuators,
        @JsonProperty(required = true) List<Muscle> muscles, Skin skin) {

    /** The version of the protocol that is read here. */
    public static final int PROTOCOL = 2;
    /** Keeps the size of a frame within what one array can hold. */
    static final int MAX_PARTICLES = 10_000_000;
    static final int MAX_ACTUATORS = 100_000;

    /** A JSON null counts as absent, and absent companions and periodic axes as none. */
    public StreamScene {
        periodic = periodic == null ? Map.of() : periodic;
        companions = companions == null ? List.of() : companions;
        overrides = present(overrides);
        gait = present(gait);
    }

    /** Whether it is plane flow: its water is on a lattice one cell deep. */
    public boolean isPlane() {
        return "lattice".equals(scheme) && definition.path("fluid").path("count").path(1).asInt() == 1;
    }

    private static JsonNode present(JsonNode node) {
        return node == null || node.isNull() ? null : node;
    }

    /**
     * A body beside the one that swims.
     *
     * @param name   of its creature
     * @param body   indices of its particles
     * @param slices indices of each slice's particles, from the head on
     */
    @JsonIgnoreProperties(ignoreUnknown = true)
    public record Companion(String name, @JsonProperty(required = true) List<Integer> body,
            @JsonProperty(required = true) List<List<Integer>> slices) {
    }

    /**
     * A spring between two particles that contracts: its length is (1 + ½ lateral a u) times that at rest, with a u of
     * its actuator from the frame.
     *
     * @param a          particle
     * @param b          particle
     * @param actuator   0 = nearest the head
     * @param lateral    −1 at the left edge to +1 at the right edge; of one that bends up and down, lower and upper
     * @param restLength length
     */
    @JsonIgnoreProperties(ignoreUnknown = true)
    public record Muscle(@JsonProperty(required = true) int a, @JsonProperty(required = true) int b,
            @JsonProperty(required = true) int actuator, @JsonProperty(required = true) double lateral,
            @JsonProperty(required = true) double restLength) {
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
        expect(mass != null && mass.size() == particles, "mass has " + sizeOf(mass) + " numbers; expected "
                + particles);
        expect(fields != null && fields.stream().distinct().sorted().toList().equals(fields),
                "fields are " + fields + "; expected some of position, velocity, density in this order");
        expect(fluid != null && fluid.size() == 2 && fluid.get(0) >= 0 && fluid.get(1) >= 0
                && fluid.get(0) + (long) fluid.get(1) <= particles,
                "fluid is " + fluid + "; expected [first, count] of at most " + particles + " particles");
        indices("body", body, particles);
        lists("slices", slices);
        for (Companion companion : companions) {
            expect(companion != null, "companions: expected objects");
            indices("companions.body", companion.body, particles);
            lists("companions.slices", companion.slices);
        }
        lists("clusters", clusters);
        indices("joints", joints, sizeOf(slices));
        expect(planes != null && planes.stream().allMatch(plane -> plane != null && plane.size() == 4
                && plane.stream().allMatch(number -> number != null)), "planes: expected four numbers each");
        expect(periodic.entrySet().stream().allMatch(axis -> axis.getKey().matches("x|z") && axis.getValue() != null
                && axis.getValue().size() == 2 && axis.getValue().stream().allMatch(number -> number != null)),
                "periodic: expected x or z with two numbers each");
        expect(muscles != null, "muscles: expected a list");
        for (Muscle muscle : muscles) {
            expect(muscle != null && muscle.a >= 0 && muscle.a < particles && muscle.b >= 0 && muscle.b < particles
                    && muscle.actuator >= 0 && muscle.actuator < actuators,
                    "muscle " + muscle
                            + "; expected particles below " + particles + " and an actuator below " + actuators);
        }
        expect(skin == null || skin.fits(body.size(), clusters.size()),
                "skin: expected vertices, triangles and places of rest that fit the body");
    }

    private void lists(String key, List<List<Integer>> lists) throws StreamException {
        expect(lists != null, key + ": expected a list");
        for (List<Integer> list : lists) {
            indices(key, list, particles);
        }
    }

    private static void indices(String key, List<Integer> indices, int end) throws StreamException {
        expect(indices != null && indices.stream().allMatch(index -> index != null && index >= 0 && index < end),
                key + ": expected indices below " + end);
    }

    private static void within(String key, int value, int limit) throws StreamException {
        expect(value >= 0 && value <= limit, key + " is " + value + "; expected 0 to " + limit);
    }

    private static int sizeOf(List<?> list) {
        return list == null ? 0 : list.size();
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
