#pragma once

namespace natator::cuda {

/// Row by row, of a unit quaternion x, y, z, w.
template <class Real>
__device__ void rotation_matrix(const Real q[4], Real m[9]) {
    const Real x = q[0], y = q[1], z = q[2], w = q[3];
    m[0] = 1 - 2 * (y * y + z * z);
    m[1] = 2 * (x * y - w * z);
    m[2] = 2 * (x * z + w * y);
    m[3] = 2 * (x * y + w * z);
    m[4] = 1 - 2 * (x * x + z * z);
    m[5] = 2 * (y * z - w * x);
    m[6] = 2 * (x * z - w * y);
    m[7] = 2 * (y * z + w * x);
    m[8] = 1 - 2 * (x * x + y * y);
}

/// Turns the rotation q towards the covariance (row by row). As cpu/rotation_fit.cpp.
__device__ inline void fit_rotation(const double covariance[9], double q[4], int steps) {
    constexpr double epsilon = 1e-9;
    for (int step = 0; step < steps; ++step) {
        double r[9];
        rotation_matrix(q, r);
        double omega[3] = {}, trace = 0;
        for (int k = 0; k < 3; ++k) {  // column k of r cross column k of the covariance
            omega[0] += r[3 + k] * covariance[6 + k] - r[6 + k] * covariance[3 + k];
            omega[1] += r[6 + k] * covariance[k] - r[k] * covariance[6 + k];
            omega[2] += r[k] * covariance[3 + k] - r[3 + k] * covariance[k];
        }
        for (int e = 0; e < 9; ++e) trace += r[e] * covariance[e];
        const double scale = 1 / (fabs(trace) + epsilon);
        for (double& component : omega) component *= scale;
        const double angle = sqrt(omega[0] * omega[0] + omega[1] * omega[1] + omega[2] * omega[2]);
        if (angle < epsilon) return;
        double sine, cosine;
        sincos(angle / 2, &sine, &cosine);
        const double s = sine / angle;
        const double a[4] = {s * omega[0], s * omega[1], s * omega[2], cosine};
        const double turned[4] = {a[3] * q[0] + a[0] * q[3] + a[1] * q[2] - a[2] * q[1],
                                  a[3] * q[1] + a[1] * q[3] + a[2] * q[0] - a[0] * q[2],
                                  a[3] * q[2] + a[2] * q[3] + a[0] * q[1] - a[1] * q[0],
                                  a[3] * q[3] - a[0] * q[0] - a[1] * q[1] - a[2] * q[2]};
        const double size =
            rsqrt(turned[0] * turned[0] + turned[1] * turned[1] + turned[2] * turned[2] + turned[3] * turned[3]);
        for (int e = 0; e < 4; ++e) q[e] = size * turned[e];
    }
}

}  // namespace natator::cuda
