package io.natator.body;

import com.fasterxml.jackson.annotation.JsonCreator;
import com.fasterxml.jackson.annotation.JsonValue;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.base.InvalidInputException;
import io.natator.base.MergePatch;
import io.soabase.recordbuilder.core.RecordBuilder;
import java.util.ArrayList;
import java.util.List;

/**
 * A body given by curves along its length, the {@code profile} of a scene's creature with its stiffness. Lengths are in scene
 * units, places in parts of the length, from 0 at the nose to 1 at the end of the tail.
 *
 * @param spacing   of neighbouring particles
 * @param length    from outside to outside, fin included
 * @param height    of the elliptic cross-sections
 * @param width     of the same
 * @param fin       height of the tail fin from where it begins, or null without one
 * @param thickness of the fin
 * @param joints    ascending, at least one
 * @param stiffness of the clusters, from 0 to 1
 * @param muscles   stiffness of the muscles' springs, from 0 to 1: how hard they pull
 */
@RecordBuilder
public record ProfileBody(double spacing, double length, Curve height, Curve width, Curve fin, double thickness,
        List<Double> joints, Curve stiffness, Curve muscles) implements ProfileBodyBuilder.With {

    private static final double SPACING = 0.075;
    private static final double CLUSTER_STIFFNESS = 0.2;
    private static final double SPRING_STIFFNESS = 1;
    /** Slices: a part that is written in decimals lies in the slice that begins there. */
    private static final double ON_BORDER = 1e-9;

    /** Copies the joints. */
    public ProfileBody {
        joints = List.copyOf(joints);
    }

    /**
     * Reads a creature as the simulator defines it ({@code natator-sim info SCENE --json --definition}).
     *
     * @throws InvalidInputException if its body is not given by a profile, or its muscles by numbers of slices
     */
    @JsonCreator(mode = JsonCreator.Mode.DELEGATING)
    public static ProfileBody of(JsonNode creature) {
        JsonNode profile = creature.path("profile");
        if (!profile.path("length").isNumber() || !profile.path("joints").isArray() || !profile.has("height")
                || !profile.has("width")) {
            throw new InvalidInputException(
                    "the creature's body is not given by a profile, so it has no genes; expected one that "
                            + "is, as in open-water/eel, open-water/tadpole, open-water/tuna, and those in pool/ and endless/eel");
        }
        if (creature.has("muscleSlices")) {
            throw new InvalidInputException(
                    "creature.muscleSlices names slices, which a longer body has elsewhere; expected a body "
                            + "whose muscles run between its joints");
        }
        JsonNode fin = profile.path("fin");
        boolean hasFin = fin.has("height");
        double spacing = creature.path("spacing").asDouble(SPACING);
        List<Double> joints = new ArrayList<>();
        profile.get("joints").forEach(joint -> joints.add(joint.asDouble()));
        return new ProfileBody(spacing, profile.get("length").doubleValue(),
                Curve.of(profile.get("height"), "creature.profile.height"),
                Curve.of(profile.get("width"), "creature.profile.width"),
                hasFin ? Curve.of(fin.get("height"), "creature.profile.fin.height") : null,
                hasFin ? fin.path("thickness").asDouble(spacing) : 0, joints,
                stiffness(creature, "clusterStiffness", CLUSTER_STIFFNESS),
                stiffness(creature, "springStiffness", SPRING_STIFFNESS));
    }

    private static Curve stiffness(JsonNode creature, String key, double usual) {
        return creature.has(key) ? Curve.of(creature.get(key), "creature." + key)
                : new Curve(List.of(new Curve.Point(0, usual)));
    }

    /** The JSON form, as in a scene's {@code creature}. */
    @JsonValue
    public ObjectNode json() {
        ObjectNode creature = JsonNodeFactory.instance.objectNode();
        creature.put("spacing", spacing);
        creature.setAll(shape());
        return creature;
    }

    /** All but the spacing, which is the scene's. */
    private ObjectNode shape() {
        ObjectNode creature = JsonNodeFactory.instance.objectNode();
        ObjectNode profile = creature.putObject("profile");
        profile.put("length", length);
        profile.set("height", height.json());
        profile.set("width", width.json());
        if (fin != null) {
            ObjectNode tail = profile.putObject("fin");
            tail.set("height", fin.json());
            tail.put("thickness", thickness);
        }
        ArrayNode places = profile.putArray("joints");
        joints.forEach(places::add);
        creature.set("clusterStiffness", stiffness.json());
        creature.set("springStiffness", muscles.json());
        return creature;
    }

    /** The JSON Merge Patch that gives a scene this body. */
    public JsonNode patch() {
        ObjectNode patch = JsonNodeFactory.instance.objectNode();
        patch.set("creature", shape());
        return patch;
    }

    /** The body that a patch on this one's scene makes of it; null for no patch. */
    public ProfileBody with(JsonNode patch) {
        return patch == null || !patch.has("creature") ? this : of(MergePatch.both(json(), patch.get("creature")));
    }

    /** How many slices of particles it has. */
    public int slices() {
        return (int) Math.round(length / spacing);
    }

    /** Head to tail at rest from centre to centre, in scene units: what results count in. */
    public double bodyLength() {
        return (slices() - 1) * spacing;
    }

    /** Where the middle of a slice is. */
    double part(double slice) {
        return (slice + 0.5) / slices();
    }

    /** Where the fin begins; 1 without one. */
    public double finBegin() {
        return fin == null ? 1 : fin.points().get(0).at();
    }

    /** Its outline from nose to tail: [part of the length, height, width] at each slice and both ends, lengths in scene units. */
    public List<double[]> sections() {
        List<double[]> sections = new ArrayList<>();
        for (int slice = -1; slice <= slices(); slice++) {
            double place = Math.min(Math.max(part(slice), 0), 1);
            boolean isFin = fin != null && place >= finBegin();
            sections.add(new double[] {place, (isFin ? fin : height).at(place), isFin ? thickness : width.at(place)});
        }
        return sections;
    }

    /** Where joints end: where the fin begins if that is one particle thick, since no muscle fits there; else 1. */
    double jointEnd() {
        return Math.round(thickness / spacing) > 1 ? 1 : finBegin();
    }

    /** How many particles it has, each of which stands for a cube of the spacing. */
    public int particles() {
        int sum = 0;
        for (int slice = 0; slice < slices(); slice++) {
            double place = part(slice);
            sum += fin != null && place >= finBegin() ? CrossSection.plate(fin.at(place) / spacing, thickness / spacing)
                    : CrossSection.ellipse(height.at(place) / spacing, width.at(place) / spacing);
        }
        return sum;
    }

    /** Numbers of the slices that the joints are in. */
    List<Integer> jointSlices() {
        return joints.stream().map(joint -> (int) (joint * slices() + ON_BORDER)).toList();
    }

    /** How hard the muscles between neighbouring joints pull together. */
    double strength() {
        List<Integer> ends = jointSlices();
        double sum = 0;
        for (int i = 1; i < ends.size(); i++) {
            sum += muscles.at(part((ends.get(i - 1) + ends.get(i)) / 2.0));
        }
        return sum;
    }
}
