package io.natator.export;

import java.util.List;
import java.util.function.IntFunction;
import org.hipparchus.linear.LUDecomposition;
import org.hipparchus.linear.MatrixUtils;
import org.hipparchus.linear.RealMatrix;
import org.hipparchus.linear.SingularValueDecomposition;

/**
 * The rigid motion that brings a cluster's particles nearest to where they are (Kabsch 1976): turned about one place,
 * which goes to another.
 *
 * @param turn 3 × 3, of determinant 1
 * @param from mean place at rest, length
 * @param to   mean place now, length
 */
record ClusterMotion(RealMatrix turn, double[] from, double[] to) {

    static final int AXES = 3;
    private static final int QUATERNION = 4;

    /**
     * Fits the motion.
     *
     * @param cluster  its particles
     * @param rest     x, y, z of each at rest
     * @param position x, y, z of all particles now
     */
    static ClusterMotion of(List<Integer> cluster, IntFunction<double[]> rest, float[] position) {
        double[] from = new double[AXES];
        double[] to = new double[AXES];
        for (int particle : cluster) {
            for (int axis = 0; axis < AXES; axis++) {
                from[axis] += rest.apply(particle)[axis] / cluster.size();
                to[axis] += (double) position[AXES * particle + axis] / cluster.size();
            }
        }
        double[][] moment = new double[AXES][AXES];
        for (int particle : cluster) {
            for (int row = 0; row < AXES; row++) {
                for (int column = 0; column < AXES; column++) {
                    moment[row][column] += (position[AXES * particle + row] - to[row])
                            * (rest.apply(particle)[column] - from[column]);
                }
            }
        }
        SingularValueDecomposition fit = new SingularValueDecomposition(MatrixUtils.createRealMatrix(moment));
        RealMatrix turn = fit.getU().multiply(fit.getVT());
        if (new LUDecomposition(turn).getDeterminant() < 0) {  // a reflection: turn the least direction round
            RealMatrix mirror = MatrixUtils.createRealDiagonalMatrix(new double[] {1, 1, -1});
            turn = fit.getU().multiply(mirror).multiply(fit.getVT());
        }
        return new ClusterMotion(turn, from, to);
    }

    /** Where a place at rest goes. */
    double[] of(double... place) {
        double[] turned = turn.operate(new double[] {place[0] - from[0], place[1] - from[1], place[2] - from[2]});
        for (int axis = 0; axis < AXES; axis++) {
            turned[axis] += to[axis];
        }
        return turned;
    }

    /** The turn as a unit quaternion x, y, z, w (Shepperd 1978). */
    double[] quaternion() {
        double trace = turn.getTrace();
        int largest = AXES;
        double most = trace;
        for (int i = 0; i < AXES; i++) {
            if (turn.getEntry(i, i) > most) {
                largest = i;
                most = turn.getEntry(i, i);
            }
        }
        double[] q = new double[QUATERNION];
        if (largest == AXES) {
            q[AXES] = 1 + trace;
            for (int i = 0; i < AXES; i++) {
                q[i] = skew(i);
            }
        } else {
            int next = (largest + 1) % AXES;
            int last = (largest + 2) % AXES;
            q[largest] = 1 + 2 * most - trace;
            q[next] = turn.getEntry(next, largest) + turn.getEntry(largest, next);
            q[last] = turn.getEntry(last, largest) + turn.getEntry(largest, last);
            q[AXES] = skew(largest);
        }
        double norm = Math.sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[AXES] * q[AXES]);
        for (int i = 0; i < QUATERNION; i++) {
            q[i] /= norm;
        }
        return q;
    }

    private double skew(int axis) {
        int next = (axis + 1) % AXES;
        int last = (axis + 2) % AXES;
        return turn.getEntry(last, next) - turn.getEntry(next, last);
    }
}
