package io.natator.kinematics;

import org.hipparchus.linear.Array2DRowRealMatrix;
import org.hipparchus.linear.RealMatrix;
import org.hipparchus.linear.SingularValueDecomposition;

/**
 * How a body as a whole is turned against its start (thesis figure 3.1): first by θ about x, then by ρ about y, then by ω
 * about z. The rotation is that which brings the start's particles nearest to the present ones, by least squares
 * (Kabsch 1976).
 *
 * @param roll  θ about x, radians
 * @param yaw   ρ about y, radians
 * @param pitch ω about z, radians
 */
public record Attitude(double roll, double yaw, double pitch) {

    /** The attitude in a frame; [particle][x, y, z] at the start and now. */
    public static Attitude of(double[][] start, double[][] now) {
        RealMatrix covariance = centred(now).transpose().multiply(centred(start));
        SingularValueDecomposition parts = new SingularValueDecomposition(covariance);
        RealMatrix u = parts.getU();
        RealMatrix vt = parts.getVT();
        double handedness = determinant(u) * determinant(vt);
        RealMatrix mirror = new Array2DRowRealMatrix(new double[][] {{1, 0, 0}, {0, 1, 0}, {0, 0, Math.signum(handedness)}});
        double[][] r = u.multiply(mirror).multiply(vt).getData();
        return new Attitude(Math.atan2(r[2][1], r[2][2]), -Math.asin(Math.max(-1, Math.min(1, r[2][0]))),
                Math.atan2(r[1][0], r[0][0]));
    }

    private static RealMatrix centred(double[][] places) {
        double[] mean = new double[3];
        for (double[] place : places) {
            for (int axis = 0; axis < 3; axis++) {
                mean[axis] += place[axis] / places.length;
            }
        }
        double[][] result = new double[places.length][3];
        for (int i = 0; i < places.length; i++) {
            for (int axis = 0; axis < 3; axis++) {
                result[i][axis] = places[i][axis] - mean[axis];
            }
        }
        return new Array2DRowRealMatrix(result);
    }

    private static double determinant(RealMatrix m) {
        double[][] a = m.getData();
        return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) - a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0])
                + a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
    }
}
