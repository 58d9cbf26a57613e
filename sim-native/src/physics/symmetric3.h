// Symmetric matrices of three rows.
#pragma once

#include <cmath>

#include "vec3.h"

namespace natator::physics {

/// A symmetric matrix.
template <class T>
struct Symmetric3 {
    T xx{}, yy{}, zz{}, xy{}, xz{}, yz{};
};

inline namespace NATATOR_SET {

template <class T>
NATATOR_HD Vec3<T> operator*(const Symmetric3<T>& m, const Vec3<T>& v) {
    return {m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
            m.xz * v.x + m.yz * v.y + m.zz * v.z};
}
template <class T>
NATATOR_HD Symmetric3<T> operator+(const Symmetric3<T>& a, const Symmetric3<T>& b) {
    return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
}

/// det(m) times the inverse of m.
template <class T>
NATATOR_HD Symmetric3<T> adjugate(const Symmetric3<T>& m) {
    return {m.yy * m.zz - m.yz * m.yz, m.xx * m.zz - m.xz * m.xz, m.xx * m.yy - m.xy * m.xy,
            m.xz * m.yz - m.xy * m.zz, m.xy * m.yz - m.xz * m.yy, m.xy * m.xz - m.xx * m.yz};
}
/// The determinant of m, by its adjugate.
template <class T>
NATATOR_HD T determinant(const Symmetric3<T>& m, const Symmetric3<T>& adjugate) {
    return m.xx * adjugate.xx + m.xy * adjugate.xy + m.xz * adjugate.xz;
}

/// Turns rows and columns p and q of a symmetric matrix so that its entry (p, q) becomes 0, and the same columns of v.
NATATOR_HD void rotate_away(double m[3][3], double v[3][3], int p, int q) {
    if (m[p][q] == 0) return;
    const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
    const double size = (theta < 0 ? -theta : theta) + square_root(theta * theta + 1);
    const double t = theta < 0 ? -1 / size : 1 / size;
    const double c = 1 / square_root(t * t + 1), s = t * c;
    const auto turn = [c, s](double& a, double& b) {
        const double before = a;
        a = c * before - s * b;
        b = s * before + c * b;
    };
    for (int k = 0; k < 3; ++k) turn(m[k][p], m[k][q]);
    for (int k = 0; k < 3; ++k) turn(m[p][k], m[q][k]);
    for (int k = 0; k < 3; ++k) turn(v[k][p], v[k][q]);
}

/// Least-norm solution x of S x = b for a symmetric S that is not negative, by Jacobi's eigenvalue method (Golub, Van
/// Loan: Matrix Computations, 8.5). What lies along eigenvectors of eigenvalues below 1e-14 of the largest is left out.
NATATOR_HD Vec3<double> least_norm_solution(const Symmetric3<double>& s, const Vec3<double>& b) {
    double m[3][3] = {{s.xx, s.xy, s.xz}, {s.xy, s.yy, s.yz}, {s.xz, s.yz, s.zz}};
    double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const double size = s.xx + s.yy + s.zz;
    constexpr int max_sweeps = 8;
    for (int sweep = 0; sweep < max_sweeps; ++sweep) {
        const double off = m[0][1] * m[0][1] + m[0][2] * m[0][2] + m[1][2] * m[1][2];
        if (!(off > 1e-34 * size * size)) break;
        rotate_away(m, v, 0, 1);
        rotate_away(m, v, 0, 2);
        rotate_away(m, v, 1, 2);
    }
    double largest = m[0][0];
    for (int k = 1; k < 3; ++k) largest = m[k][k] > largest ? m[k][k] : largest;
    Vec3<double> x{};
    for (int k = 0; k < 3; ++k) {
        if (!(m[k][k] > 1e-14 * largest)) continue;
        const Vec3<double> axis{v[0][k], v[1][k], v[2][k]};
        x += dot(axis, b) / m[k][k] * axis;
    }
    return x;
}

}  // namespace NATATOR_SET
}  // namespace natator::physics
