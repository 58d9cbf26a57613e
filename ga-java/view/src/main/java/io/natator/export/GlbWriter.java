package io.natator.export;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import io.natator.config.InvalidInputException;
import io.natator.stream.StreamFrame;
import java.io.IOException;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

/**
 * For Blender, three.js and game engines: {@code swim.glb}, glTF 2.0. Each creature is a mesh with a bone for each of its
 * clusters; the bones move as the clusters do (see {@link ClusterMotion}). A second is a second, the unit of length a metre.
 */
final class GlbWriter implements FrameWriter {

    private static final double ROUGHNESS = 0.6;

    private final ExportContext swim;
    private final Path file;
    private final List<Float> times = new ArrayList<>();
    private final List<Animated> creatures = new ArrayList<>();

    /** A creature and, of each of its bones, x, y, z and the quaternion x, y, z, w in turn in all frames. */
    private record Animated(RiggedBody body, List<List<float[]>> places, List<List<float[]>> turns,
            List<double[]> from) {
    }

    GlbWriter(ExportContext swim, Path folder) {
        this.swim = swim;
        this.file = folder.resolve("swim.glb");
        if (swim.surface().size() == 0 && !swim.hasSkin()) {
            throw new InvalidInputException("--format glb: " + swim.scene().scene()
                    + " has no body with a surface; expected one");
        }
    }

    @Override
    public void frame(StreamFrame frame) {
        if (creatures.isEmpty()) {
            for (RiggedBody body : RiggedBody.of(swim, frame.position())) {
                creatures.add(new Animated(body, new ArrayList<>(), new ArrayList<>(), new ArrayList<>()));
            }
        }
        times.add((float) frame.time());
        for (Animated creature : creatures) {
            List<ClusterMotion> motions = creature.body.motions(frame.position());
            for (int i = 0; i < motions.size(); i++) {
                if (creature.places.size() == i) {
                    creature.places.add(new ArrayList<>());
                    creature.turns.add(new ArrayList<>());
                    creature.from.add(motions.get(i).from());
                }
                creature.places.get(i).add(floats(motions.get(i).to()));
                List<float[]> turns = creature.turns.get(i);
                turns.add(nearest(floats(motions.get(i).quaternion()), turns.isEmpty() ? null : turns.get(turns.size() - 1)));
            }
        }
    }

    private static float[] floats(double... values) {
        float[] floats = new float[values.length];
        for (int i = 0; i < values.length; i++) {
            floats[i] = (float) values[i];
        }
        return floats;
    }

    /** Of q and −q, which are the same turn, the one next to the turn before, so that curves do not jump. */
    private static float[] nearest(float[] q, float[] before) {
        double dot = 0;
        for (int i = 0; before != null && i < q.length; i++) {
            dot += q[i] * before[i];
        }
        for (int i = 0; dot < 0 && i < q.length; i++) {
            q[i] = -q[i];
        }
        return q;
    }

    @Override
    public void finish() throws IOException {
        GlbFile glb = new GlbFile(swim.title());
        ObjectNode animation = object().put("name", "Swim");
        ObjectNode scene = object().put("name", "Swim");
        ObjectNode material = object().put("name", "Skin");
        material.putObject("pbrMetallicRoughness").put("metallicFactor", 0).put("roughnessFactor", ROUGHNESS);
        glb.add("materials", material);
        ArrayNode roots = scene.putArray("nodes");
        int input = glb.times(joined(times));
        for (int i = 0; i < creatures.size(); i++) {
            add(creatures.get(i), glb, roots, animation, input);
        }
        glb.add("animations", animation);
        glb.add("scenes", scene);
        glb.write(file);
    }

    private static void add(Animated creature, GlbFile glb, ArrayNode roots, ObjectNode animation, int input) {
        RiggedBody body = creature.body;
        ObjectNode skin = object().put("name", body.name()).put("inverseBindMatrices", glb.values("MAT4", bindings(creature)));
        ObjectNode rig = object().put("name", body.name() + "Rig");
        ArrayNode bones = rig.putArray("children");
        for (int bone = 0; bone < body.clusters().size(); bone++) {
            ObjectNode node = object().put("name", body.name() + "Cluster" + bone);
            put(node.putArray("translation"), creature.places.get(bone).get(0));
            put(node.putArray("rotation"), creature.turns.get(bone).get(0));
            int place = glb.add("nodes", node);
            bones.add(place);
            skin.withArrayProperty("joints").add(place);
            animate(animation, input, glb.values("VEC3", flat(creature.places.get(bone))), place, "translation");
            animate(animation, input, glb.values("VEC4", flat(creature.turns.get(bone))), place, "rotation");
        }
        int root = glb.add("nodes", rig);
        roots.add(root);
        skin.put("skeleton", root);
        roots.add(glb.add("nodes", object().put("name", body.name()).put("mesh", mesh(body, glb))
                .put("skin", glb.add("skins", skin))));
    }

    private static int mesh(RiggedBody body, GlbFile glb) {
        ObjectNode mesh = object().put("name", body.name());
        ObjectNode primitive = mesh.putArray("primitives").addObject();
        primitive.putObject("attributes").put("POSITION", glb.places(body.places()))
                .put("NORMAL", glb.vertices("VEC3", body.normals())).put("COLOR_0", glb.vertices("VEC3", body.colours()))
                .put("JOINTS_0", glb.joints(body.bones())).put("WEIGHTS_0", glb.vertices("VEC4", body.shares()));
        primitive.put("indices", glb.corners(body.triangles())).put("material", 0);
        return glb.add("meshes", mesh);
    }

    /** From the body at rest to each bone's own origin: a shift; matrices by columns. */
    private static float[] bindings(Animated creature) {
        float[] matrices = new float[16 * creature.from.size()];
        for (int bone = 0; bone < creature.from.size(); bone++) {
            for (int axis = 0; axis < 3; axis++) {
                matrices[16 * bone + 5 * axis] = 1;
                matrices[16 * bone + 12 + axis] = (float) -creature.from.get(bone)[axis];
            }
            matrices[16 * bone + 15] = 1;
        }
        return matrices;
    }

    private static void animate(ObjectNode animation, int input, int output, int node, String path) {
        ArrayNode samplers = animation.withArrayProperty("samplers");
        ObjectNode channel = animation.withArrayProperty("channels").addObject().put("sampler", samplers.size());
        channel.putObject("target").put("node", node).put("path", path);
        samplers.addObject().put("input", input).put("output", output).put("interpolation", "LINEAR");
    }

    private static void put(ArrayNode array, float... values) {
        for (float value : values) {
            array.add(value);
        }
    }

    private static float[] flat(List<float[]> rows) {
        float[] all = new float[rows.size() * rows.get(0).length];
        for (int i = 0; i < rows.size(); i++) {
            System.arraycopy(rows.get(i), 0, all, i * rows.get(i).length, rows.get(i).length);
        }
        return all;
    }

    private static float[] joined(List<Float> values) {
        float[] all = new float[values.size()];
        for (int i = 0; i < all.length; i++) {
            all[i] = values.get(i);
        }
        return all;
    }

    private static ObjectNode object() {
        return JsonNodeFactory.instance.objectNode();
    }

    @Override
    public void close() {
        // Nothing is open before the end.
    }
}
