package io.natator.export;

import io.natator.stream.Skin;
import io.natator.stream.StreamScene;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.function.IntFunction;
import java.util.stream.IntStream;

/**
 * A creature's surface and the clusters that move it, as a mesh with bones: each vertex follows up to
 * {@value #BONES_PER_VERTEX} clusters by shares.
 *
 * @param name      of the creature in files
 * @param clusters  particles of each bone
 * @param rest      x, y, z of each particle at rest
 * @param places    x, y, z of each vertex at rest
 * @param triangles three vertices each, counter-clockwise seen from outside
 * @param colours   red, green, blue of each vertex
 * @param bones     {@value #BONES_PER_VERTEX} for each vertex; 0 where the share is
 * @param shares    of each of these
 */
record RiggedBody(String name, List<List<Integer>> clusters, IntFunction<double[]> rest, float[] places,
        int[] triangles, float[] colours, short[] bones, float[] shares) {

    static final int BONES_PER_VERTEX = 4;
    private static final int AXES = 3;

    /**
     * All creatures of a swim that have a surface.
     *
     * @param start x, y, z of all particles in the settled start
     */
    static List<RiggedBody> of(ExportContext swim, float[] start) {
        StreamScene scene = swim.scene();
        List<RiggedBody> bodies = new ArrayList<>();
        for (int i = 0; i < swim.surfaces().size(); i++) {
            if (i == 0 && swim.hasSkin()) {
                bodies.add(ofSkin(scene, clustersOf(scene, 0)));
            } else if (swim.surfaces().get(i).size() > 0) {
                bodies.add(ofSlices(i == 0 ? "Body" : "Companion" + i, swim.surfaces().get(i),
                        ParticleSet.ofCreature(scene, i), clustersOf(scene, i), start));
            }
        }
        return bodies;
    }

    /** The clusters of a creature; without any, all of its particles. */
    private static List<List<Integer>> clustersOf(StreamScene scene, int creature) {
        int[] creatures = ParticleSet.creatures(scene);
        List<List<Integer>> own = scene.clusters().stream()
                .filter(cluster -> !cluster.isEmpty() && creatures[cluster.get(0)] == creature).toList();
        ParticleSet all = ParticleSet.ofCreature(scene, creature);
        return own.isEmpty() ? List.of(IntStream.range(0, all.size()).map(all::index).boxed().toList()) : own;
    }

    private static RiggedBody ofSkin(StreamScene scene, List<List<Integer>> clusters) {
        Skin skin = scene.skin();
        Map<Integer, double[]> rest = SkinMotion.restOf(scene);
        RiggedBody body = empty("Body", clusters, rest::get, skin.vertices().size(),
                skin.triangles().stream().flatMapToInt(IntStream::of).toArray());
        for (int i = 0; i < skin.vertices().size(); i++) {
            int cluster = skin.cluster()[i];
            body.set(i, skin.vertices().get(i), cluster);
            body.follow(i, 0, cluster, (float) skin.share()[i]);
            if (skin.share()[i] < 1) {
                body.follow(i, 1, cluster + 1, (float) (1 - skin.share()[i]));
            }
        }
        return body;
    }

    private static RiggedBody ofSlices(String name, BodySurface surface, ParticleSet particles,
            List<List<Integer>> clusters, float[] start) {
        int[] corners = surface.corners(particles);
        int[] used = IntStream.of(corners).distinct().sorted().toArray();
        Map<Integer, Integer> vertexOf = new HashMap<>();
        for (int i = 0; i < used.length; i++) {
            vertexOf.put(used[i], i);
        }
        RiggedBody body = empty(name, clusters, particle -> place(start, particle), used.length,
                IntStream.of(corners).map(vertexOf::get).toArray());
        for (int i = 0; i < used.length; i++) {
            int particle = particles.index(used[i]);
            int[] owners = IntStream.range(0, clusters.size()).filter(c -> clusters.get(c).contains(particle))
                    .limit(BONES_PER_VERTEX).toArray();
            body.set(i, place(start, particle), owners.length == 0 ? 0 : owners[0]);
            for (int k = 0; k < owners.length; k++) {
                body.follow(i, k, owners[k], 1f / owners.length);
            }
            if (owners.length == 0) {
                body.follow(i, 0, 0, 1);
            }
        }
        return body;
    }

    private static double[] place(float[] position, int particle) {
        return new double[] {position[AXES * particle], position[AXES * particle + 1], position[AXES * particle + 2]};
    }

    private static RiggedBody empty(String name, List<List<Integer>> clusters, IntFunction<double[]> rest,
            int vertices, int[] triangles) {
        return new RiggedBody(name, clusters, rest, new float[AXES * vertices], triangles, new float[AXES * vertices],
                new short[BONES_PER_VERTEX * vertices], new float[BONES_PER_VERTEX * vertices]);
    }

    private void set(int vertex, double[] place, int cluster) {
        float[] colour = ClusterColours.of(cluster);
        for (int axis = 0; axis < AXES; axis++) {
            places[AXES * vertex + axis] = (float) place[axis];
            colours[AXES * vertex + axis] = colour[axis];
        }
    }

    private void follow(int vertex, int k, int cluster, float share) {
        bones[BONES_PER_VERTEX * vertex + k] = (short) cluster;
        shares[BONES_PER_VERTEX * vertex + k] = share;
    }

    /** The motions of all clusters to where the particles are. */
    List<ClusterMotion> motions(float[] position) {
        return clusters.stream().map(cluster -> ClusterMotion.of(cluster, rest, position)).toList();
    }

    /** For each vertex the mean direction of its triangles' outer sides, weighted by area: x, y, z of length 1. */
    float[] normals() {
        double[] sums = new double[places.length];
        for (int t = 0; t < triangles.length; t += AXES) {
            double[] normal = cross(triangles[t], triangles[t + 1], triangles[t + 2]);
            for (int corner = t; corner < t + AXES; corner++) {
                for (int axis = 0; axis < AXES; axis++) {
                    sums[AXES * triangles[corner] + axis] += normal[axis];
                }
            }
        }
        float[] normals = new float[places.length];
        for (int i = 0; i < normals.length; i += AXES) {
            double length = Math.sqrt(sums[i] * sums[i] + sums[i + 1] * sums[i + 1] + sums[i + 2] * sums[i + 2]);
            for (int axis = 0; axis < AXES; axis++) {
                normals[i + axis] = (float) (length > 0 ? sums[i + axis] / length : axis == 1 ? 1 : 0);
            }
        }
        return normals;
    }

    private double[] cross(int a, int b, int c) {
        double[] u = new double[AXES];
        double[] v = new double[AXES];
        for (int axis = 0; axis < AXES; axis++) {
            u[axis] = (double) places[AXES * b + axis] - places[AXES * a + axis];
            v[axis] = (double) places[AXES * c + axis] - places[AXES * a + axis];
        }
        return new double[] {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    }
}
