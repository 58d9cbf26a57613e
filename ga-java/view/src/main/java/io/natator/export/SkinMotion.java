package io.natator.export;

import io.natator.stream.Skin;
import io.natator.stream.StreamScene;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import org.hipparchus.linear.LUDecomposition;
import org.hipparchus.linear.MatrixUtils;
import org.hipparchus.linear.RealMatrix;
import org.hipparchus.linear.SingularValueDecomposition;

/**
 * Where the skin of a body is: each cluster's rigid motion is fitted to its particles (Kabsch 1976), and vertices are
 * blended linearly between two clusters.
 */
final class SkinMotion {

    private static final int AXES = 3;

    private final Skin skin;
    private final List<List<Integer>> clusters;
    private final Map<Integer, double[]> rest = new HashMap<>();

    /**
     * A motion of a scene's skin.
     *
     * @param scene one that has a skin
     */
    SkinMotion(StreamScene scene) {
        skin = scene.skin();
        clusters = scene.clusters();
        for (int i = 0; i < scene.body().size(); i++) {
            rest.put(scene.body().get(i), skin.rest().get(i));
        }
    }

    /** A rigid motion: turned about one point, which goes to another. */
    private record Motion(RealMatrix turn, double[] from, double[] to) {

        double[] of(double[] place) {
            double[] turned = turn.operate(new double[] {place[0] - from[0], place[1] - from[1], place[2] - from[2]});
            for (int axis = 0; axis < AXES; axis++) {
                turned[axis] += to[axis];
            }
            return turned;
        }
    }

    /** Places of the vertices, x, y, z each, where the particles have these. */
    float[] places(float[] position) {
        List<Motion> motions = clusters.stream().map(cluster -> motion(cluster, position)).toList();
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

    private Motion motion(List<Integer> cluster, float[] position) {
        double[] from = new double[AXES];
        double[] to = new double[AXES];
        for (int particle : cluster) {
            for (int axis = 0; axis < AXES; axis++) {
                from[axis] += rest.get(particle)[axis] / cluster.size();
                to[axis] += (double) position[AXES * particle + axis] / cluster.size();
            }
        }
        double[][] moment = new double[AXES][AXES];
        for (int particle : cluster) {
            for (int row = 0; row < AXES; row++) {
                for (int column = 0; column < AXES; column++) {
                    moment[row][column] += (position[AXES * particle + row] - to[row])
                            * (rest.get(particle)[column] - from[column]);
                }
            }
        }
        SingularValueDecomposition fit = new SingularValueDecomposition(MatrixUtils.createRealMatrix(moment));
        RealMatrix turn = fit.getU().multiply(fit.getVT());
        if (new LUDecomposition(turn).getDeterminant() < 0) {  // a reflection: turn the least direction round
            RealMatrix mirror = MatrixUtils.createRealDiagonalMatrix(new double[] {1, 1, -1});
            turn = fit.getU().multiply(mirror).multiply(fit.getVT());
        }
        return new Motion(turn, from, to);
    }
}
