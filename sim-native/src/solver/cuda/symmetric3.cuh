#pragma once

namespace natator::cuda {

/// Turns rows and columns p and q of a symmetric matrix so that its entry (p, q) becomes 0, and the same columns of v.
__device__ inline void rotate_away(double m[3][3], double v[3][3], int p, int q) {
    if (m[p][q] == 0) return;
    const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
    const double t = copysign(1.0, theta) / (fabs(theta) + sqrt(theta * theta + 1));
    const double c = 1 / sqrt(t * t + 1), s = t * c;
    for (int k = 0; k < 3; ++k) {
        const double a = m[k][p], b = m[k][q];
        m[k][p] = c * a - s * b;
        m[k][q] = s * a + c * b;
    }
    for (int k = 0; k < 3; ++k) {
        const double a = m[p][k], b = m[q][k];
        m[p][k] = c * a - s * b;
        m[q][k] = s * a + c * b;
    }
    for (int k = 0; k < 3; ++k) {
        const double a = v[k][p], b = v[k][q];
        v[k][p] = c * a - s * b;
        v[k][q] = s * a + c * b;
    }
}

/// Least-norm solution x of S x = b for a symmetric S with entries xx, yy, zz, xy, xz, yz that is not negative, by
/// Jacobi's eigenvalue method (Golub, Van Loan: Matrix Computations, 8.5). What lies along eigenvectors of eigenvalues
/// below 1e-14 of the largest is left out.
__device__ inline void solve_least_norm(const double entries[6], const double b[3], double x[3]) {
    double m[3][3] = {{entries[0], entries[3], entries[4]},
                      {entries[3], entries[1], entries[5]},
                      {entries[4], entries[5], entries[2]}};
    double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const double size = entries[0] + entries[1] + entries[2];
    constexpr int most_sweeps = 8;
    for (int sweep = 0; sweep < most_sweeps; ++sweep) {
        if (!(fabs(m[0][1]) + fabs(m[0][2]) + fabs(m[1][2]) > 1e-17 * size)) break;
        rotate_away(m, v, 0, 1);
        rotate_away(m, v, 0, 2);
        rotate_away(m, v, 1, 2);
    }
    const double largest = fmax(m[0][0], fmax(m[1][1], m[2][2]));
    x[0] = x[1] = x[2] = 0;
    for (int k = 0; k < 3; ++k) {
        if (!(m[k][k] > 1e-14 * largest)) continue;
        const double along = (v[0][k] * b[0] + v[1][k] * b[1] + v[2][k] * b[2]) / m[k][k];
        for (int axis = 0; axis < 3; ++axis) x[axis] += along * v[axis][k];
    }
}

}  // namespace natator::cuda
