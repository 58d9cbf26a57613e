// The rotation closest to a covariance of arms. Rotations are quaternions x, y, z, w; matrices stand row by row.
#pragma once

#include "constants.h"
#include "symmetric3.h"
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

/// Turns the rotation q by the quaternion a, of any length but 0: a q / |a q|.
NATATOR_HD void turn_by(const double a[4], double q[4]) {
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

/// Turns the rotation q by `omega`, of length `angle` (rad).
NATATOR_HD void turn(double q[4], const Vec3<double>& omega, double angle) {
#if defined(__CUDA_ARCH__)
    double sine, cosine;
    sincos(0.5 * angle, &sine, &cosine);
#else
    const double sine = std::sin(0.5 * angle), cosine = std::cos(0.5 * angle);
#endif
    const Vec3<double> axis = sine * (omega / angle);
    const double a[4] = {axis.x, axis.y, axis.z, cosine};
    turn_by(a, q);
}

/// A step of Müller, Bender, Chentanez, Macklin: A Robust Method to Extract the Rotational Part of Deformations (2016),
/// algorithm 1:
///   omega = slope / (|trace| + epsilon), slope = sum of r_k x a_k, trace = sum of r_k . a_k, k over the columns.
NATATOR_HD Vec3<double> robust_step(const Vec3<double>& slope, double trace) {
    return slope / ((trace < 0 ? -trace : trace) + fit_epsilon);
}

/// Scheme `flex`: turns q towards the rotation closest to a covariance by a few robust steps. matrix_of(q, r) is
/// rotation_matrix, or the same with products rounded its own way.
template <class MatrixOf>
NATATOR_HD void fit_rotation(const Covariance& covariance, double q[4], const MatrixOf& matrix_of) {
    const double* const a = covariance.entry;
    for (int step = 0; step < flex_fit_steps; ++step) {
        double r[9];
        matrix_of(q, r);
        Vec3<double> slope{};
        for (int k = 0; k < 3; ++k)
            slope += cross(Vec3<double>{r[k], r[3 + k], r[6 + k]}, Vec3<double>{a[k], a[3 + k], a[6 + k]});
        // Summed in the order of a state's hash: two sums of every other entry, column by column.
        const double even = (r[0] * a[0] + r[6] * a[6]) + (r[4] * a[4] + r[2] * a[2]);
        const double odd = (r[3] * a[3] + r[1] * a[1]) + (r[7] * a[7] + r[5] * a[5]);
        const double trace = (even + odd) + r[8] * a[8];
        const Vec3<double> omega = robust_step(slope, trace);
        const double angle = norm(omega);
        if (angle < fit_epsilon) return;
        turn(q, omega, angle);
    }
}

NATATOR_HD void fit_rotation(const Covariance& covariance, double q[4]) {
    fit_rotation(covariance, q, [](const double from[4], double matrix[9]) { rotation_matrix(from, matrix); });
}

/// Solves H omega = slope for a positive definite H by its adjugate. False where H is not, or has a determinant that
/// tells only rounding, as about the axis of a straight line of particles.
NATATOR_HD bool newton_step(const Symmetric3<double>& h, const Vec3<double>& slope, Vec3<double>& omega) {
    const Symmetric3<double> inverted = adjugate(h);
    const double size = determinant(h, inverted), trace = (h.xx + h.yy) + h.zz;
    if (!(h.xx > 0 && inverted.zz > 0 && size > min_fit_determinant * (trace * trace * trace))) return false;
    omega = (inverted * slope) / size;
    return true;
}

/// Scheme `conserving`: turns q to the rotation R closest to a covariance A, that of the greatest tr(R^T A), where A
/// R^T is symmetric. Newton's method, from q on, as in the analytic polar decomposition of Kugelstadt, Koschier,
/// Bender: Fast Corotated FEM using Operator Splitting (2018):
///   ((tr S) 1 - S) omega = sum of r_k x a_k, S the symmetric part of A R^T,
/// and a turn by Cayley's map of omega, by 2 atan(|omega| / 2). Far from R, or where A tells nothing of an axis, a step
/// is a robust one. The error left, rad, is of the square of the last step.
NATATOR_HD void closest_rotation(const Covariance& covariance, double q[4]) {
    const double* const a = covariance.entry;
    for (int step = 0; step < max_fit_steps; ++step) {
        double r[9], m[9];  // R, A R^T
        rotation_matrix(q, r);
        for (int e = 0; e < 9; ++e) {
            const int i = e / 3 * 3, j = e % 3 * 3;
            m[e] = (a[i] * r[j] + a[i + 1] * r[j + 1]) + a[i + 2] * r[j + 2];
        }
        const Vec3<double> slope{m[7] - m[5], m[2] - m[6], m[3] - m[1]};
        const Symmetric3<double> h{m[4] + m[8],        m[0] + m[8],        m[0] + m[4],
                                   -(m[1] + m[3]) / 2, -(m[2] + m[6]) / 2, -(m[5] + m[7]) / 2};
        Vec3<double> omega;
        if (!newton_step(h, slope, omega) || !(dot(omega, omega) < 1)) omega = robust_step(slope, (m[0] + m[4]) + m[8]);
        const double cayley[4] = {omega.x / 2, omega.y / 2, omega.z / 2, 1};
        turn_by(cayley, q);
        if (dot(omega, omega) < fit_tolerance * fit_tolerance) return;
    }
}

}  // namespace NATATOR_SET
}  // namespace natator::physics
