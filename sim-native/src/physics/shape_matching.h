// Shape matching: Müller, Heidelberger, Teschner, Gross: Meshless Deformations Based on Shape Matching (2005). A
// cluster pulls its particles to the goals c + R r_j, r_j = rest position from the centre, c = centre, R = best rotation.
// Rotations are quaternions x, y, z, w; matrices stand row by row.
#pragma once

#include "constants.h"
#include "vec3.h"

namespace natator::physics {

/// Sum of current arm times rest arm transposed.
struct Covariance {
    double entry[9] = {};
};

inline namespace NATATOR_SET {

template <class T>
NATATOR_HD void rotation_matrix(const T q[4], T m[9]) {
    const T x = q[0], y = q[1], z = q[2], w = q[3];
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

template <class T>
NATATOR_HD Vec3<T> turned(const T m[9], const Vec3<T>& v) {
    return {dot(Vec3<T>{m[0], m[1], m[2]}, v), dot(Vec3<T>{m[3], m[4], m[5]}, v),
            m[6] * v.x + (m[7] * v.y + m[8] * v.z)};
}

/// Scheme `flex`, without masses: the products are rounded to T.
template <class T>
NATATOR_HD void add_arm(Covariance& covariance, const Vec3<T>& arm, const Vec3<T>& rest) {
    const T a[3] = {arm.x, arm.y, arm.z}, r[3] = {rest.x, rest.y, rest.z};
    for (int e = 0; e < 9; ++e) covariance.entry[e] += static_cast<double>(a[e / 3] * r[e % 3]);
}
/// Scheme `conserving`.
NATATOR_HD void add_arm(Covariance& covariance, double mass, const Vec3<double>& arm, const Vec3<double>& rest) {
    const double a[3] = {arm.x, arm.y, arm.z}, r[3] = {rest.x, rest.y, rest.z};
    for (int e = 0; e < 9; ++e) covariance.entry[e] += mass * a[e / 3] * r[e % 3];
}

/// Turns the rotation q by `omega`, of length `angle` (rad), and makes it a unit quaternion again.
NATATOR_HD void turn(double q[4], const Vec3<double>& omega, double angle) {
#if defined(__CUDA_ARCH__)
    double sine, cosine;
    sincos(0.5 * angle, &sine, &cosine);
#else
    const double sine = std::sin(0.5 * angle), cosine = std::cos(0.5 * angle);
#endif
    const Vec3<double> axis = sine * (omega / angle);
    const double a[4] = {axis.x, axis.y, axis.z, cosine};
    const double t[4] = {(a[3] * q[0] + a[1] * q[2]) - (a[2] * q[1] - a[0] * q[3]),
                         (a[3] * q[1] + a[1] * q[3]) + (a[2] * q[0] - a[0] * q[2]),
                         (a[3] * q[2] - a[1] * q[0]) + (a[2] * q[3] + a[0] * q[1]),
                         (a[3] * q[3] - a[1] * q[1]) - (a[2] * q[2] + a[0] * q[0])};
    const double square = (t[0] * t[0] + t[2] * t[2]) + (t[1] * t[1] + t[3] * t[3]);
#if defined(__CUDA_ARCH__)
    const double scale = inverse_root(square);
    for (int e = 0; e < 4; ++e) q[e] = t[e] * scale;
#else
    const double size = square_root(square);
    for (int e = 0; e < 4; ++e) q[e] = t[e] / size;
#endif
}

/// Turns q towards the rotation closest to a covariance by at most `steps` steps of Müller, Bender, Chentanez,
/// Macklin: A Robust Method to Extract the Rotational Part of Deformations (2016), algorithm 1:
///   omega = sum of r_k x a_k / (|sum of r_k . a_k| + epsilon), k over the columns.
/// matrix_of(q, r) is rotation_matrix, or the same with products rounded its own way.
template <class MatrixOf>
NATATOR_HD void fit_rotation(const Covariance& covariance, double q[4], int steps, const MatrixOf& matrix_of) {
    const double* const a = covariance.entry;
    for (int step = 0; step < steps; ++step) {
        double r[9];
        matrix_of(q, r);
        Vec3<double> omega{};
        for (int k = 0; k < 3; ++k)
            omega += cross(Vec3<double>{r[k], r[3 + k], r[6 + k]}, Vec3<double>{a[k], a[3 + k], a[6 + k]});
        // Summed in the order of a state's hash: two sums of every other entry, column by column.
        const double even = (r[0] * a[0] + r[6] * a[6]) + (r[4] * a[4] + r[2] * a[2]);
        const double odd = (r[3] * a[3] + r[1] * a[1]) + (r[7] * a[7] + r[5] * a[5]);
        const double trace = (even + odd) + r[8] * a[8];
        omega = omega / ((trace < 0 ? -trace : trace) + fit_epsilon);
        const double angle = norm(omega);
        if (angle < fit_epsilon) return;
        turn(q, omega, angle);
    }
}

NATATOR_HD void fit_rotation(const Covariance& covariance, double q[4], int steps) {
    fit_rotation(covariance, q, steps, [](const double from[4], double matrix[9]) { rotation_matrix(from, matrix); });
}

/// Scheme `flex`: a component of the stored centre takes the new mean only where the two differ by more than the dead
/// band.
template <class T>
NATATOR_HD Vec3<T> with_dead_band(const Vec3<T>& centre, const Vec3<T>& mean) {
    const auto moved = [](T from, T to) {
        const T by = to - from;
        return (by < 0 ? -by : by) > T(centre_dead_band) ? to : from;
    };
    return {moved(centre.x, mean.x), moved(centre.y, mean.y), moved(centre.z, mean.z)};
}

/// From a particle to its goal: c + R r_j - x_j.
template <class T>
NATATOR_HD Vec3<T> way_to_goal(const Vec3<T>& centre, const T matrix[9], const Vec3<T>& rest, const Vec3<T>& x) {
    return centre + turned(matrix, rest) - x;
}

/// Scheme `flex`: Dx_j = k (c + R r_j - x_j).
template <class T>
NATATOR_HD Vec3<T> goal_correction(T stiffness, const Vec3<T>& centre, const T matrix[9], const Vec3<T>& rest,
                                   const Vec3<T>& x) {
    return stiffness * way_to_goal(centre, matrix, rest, x);
}

/// Scheme `conserving`: compliance relative to the mass by XPBD, with the displacement d_j so far, to which it adds:
///   Dx_j = ((g_j - x_j) - alpha d_j) / (1 + alpha), g_j = c + R r_j in double.
template <class T>
NATATOR_HD Vec3<T> compliant_goal_change(const Vec3<double>& centre, const double matrix[9], const Vec3<T>& rest,
                                         const Vec3<T>& x, T alpha, Vec3<T>& displacement) {
    const Vec3<double> goal = centre + turned(matrix, cast<double>(rest));
    const Vec3<T> away = cast<T>(goal - cast<double>(x));
    const Vec3<T> change = (away - alpha * displacement) / (1 + alpha);
    displacement += change;
    return change;
}

}  // namespace NATATOR_SET
}  // namespace natator::physics
