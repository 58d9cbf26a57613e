package io.natator.export;

import io.natator.stream.Skin;
import io.natator.stream.StreamScene;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

/** Where the skin of a body is: vertices are blended linearly between the motions of two clusters. */
final class SkinMotion {

    private static final int AXES = ClusterMotion.AXES;

    private final Skin skin;
    private final List<List<Integer>> clusters;
    private final Map<Integer, double[]> rest;

    /**
     * A motion of a scene's skin.
     *
     * @param scene one that has a skin
     */
    SkinMotion(StreamScene scene) {
        skin = scene.skin();
        clusters = scene.clusters();
        rest = restOf(scene);
    }

    /** Of each of the body's particles x, y, z at rest, from where the skin's vertices are measured. */
    static Map<Integer, double[]> restOf(StreamScene scene) {
        Map<Integer, double[]> rest = new HashMap<>();
        for (int i = 0; i < scene.body().size(); i++) {
            rest.put(scene.body().get(i), scene.skin().rest().get(i));
        }
        return rest;
    }

    /** Places of the vertices, x, y, z each, where the particles have these. */
    float[] places(float[] position) {
        List<ClusterMotion> motions = clusters.stream()
                .filter(cluster -> rest.keySet().containsAll(cluster))  // companions have clusters too
                .map(cluster -> ClusterMotion.of(cluster, rest::get, position)).toList();
        float[] places = new float[AXES * skin.vertices().size()];
        for (int i = 0; i < skin.vertices().size(); i++) {
            double[] vertex = skin.vertices().get(i);
            int cluster = skin.cluster()[i];
            double share = skin.share()[i];
            double[] front = motions.get(cluster).of(vertex);
            double[] rear = share < 1 ? motions.get(cluster + 1).of(vertex) : front;
            for (int axis = 0; axis < AXES; axis++) {
                places[AXES * i + axis] = (float) (share * front[axis] + (1 - share) * rear[axis]);
            }
        }
        return places;
    }
}
