#pragma once

#include "number.h"

namespace natator::physics {

// Water on a D3Q27 lattice, a cell at a time. A cell holds the raw moments up to third order of its 27 populations,
// less those of water at rest: nothing else survives a collision that sets all cumulants above third order to 0. V is a
// number or a vector of them. Lengths are in cells, times in steps, densities in that of the water at rest. Population
// i = (cx + 1) + 3 (cy + 1) + 9 (cz + 1) goes by (cx, cy, cz) in a step. Moments: density - 1; x y z; xx yy zz xy xz
// yz; xxy xxz xyy yyz xzz yzz xyz.
constexpr int lattice_populations = 27, lattice_moments = 17;
/// Square of the speed of sound, cells^2/step^2: the pressure is that times the density.
constexpr float lattice_sound_squared = 1.0f / 3;

/// Part of each kind of cumulant that is left after a collision.
template <class V>
struct CellRates {
    V shear;
    float trace;
    V third;
};
/// The same where no eddies are added, and what those need: 1/w - 1/2, and 18 sqrt(2) C^2, 0 without.
struct LatticeRates {
    float shear, trace, third, slack, eddies;
};

inline namespace NATATOR_SET {

/// Where population i goes along an axis in a step: -1, 0, 1.
NATATOR_HD constexpr int along(int i, int axis) {
    return (axis == 0 ? i : axis == 1 ? i / 3 : i / 9) % 3 - 1;
}

/// The relaxation for a kinematic viscosity, cells^2/step, above 0, and Smagorinsky's constant C. Bulk viscosity: the
/// trace is relaxed at once. Third cumulants so that (1/w - 1/2)(1/w_3 - 1/2) = 1/4, which puts a wall of forced cells
/// on their centres at any viscosity (d'Humières, Ginzburg: Viscosity independent numerical errors for lattice
/// Boltzmann models, 2009).
NATATOR_HD LatticeRates lattice_rates(double viscosity, double smagorinsky) {
    constexpr double root_of_two = 1.4142135623730951;
    const double slack = 3 * viscosity;  // 1/w - 1/2
    return {static_cast<float>(1 - 1 / (slack + 0.5)), 0, static_cast<float>(1 - 1 / (0.25 / slack + 0.5)),
            static_cast<float>(slack), static_cast<float>(18 * root_of_two * smagorinsky * smagorinsky)};
}

/// a / b; on a GPU of floats, to two units in the last place for b from 2^-126 to 2^126, 0 beyond.
template <class V>
NATATOR_HD V quotient(V a, V b) {
#if defined(__CUDA_ARCH__)
    static_assert(sizeof(V) == sizeof(float));
    return __fdividef(a, b);
#else
    return a / b;
#endif
}

/// Of a cell of second cumulants xx ..., times `inverse`, of the density. Eddies smaller than cells add the viscosity
/// C^2 |S|, |S|^2 = 2 S:S, to it (Smagorinsky: General circulation experiments with the primitive equations, 1963).
/// The strain S is -3/2 w times the cumulants without their trace, so that 1/w solves a quadratic equation (Hou,
/// Sterling, Chen, Doolen: A lattice Boltzmann subgrid model for high Reynolds number flows, 1996).
template <class V>
NATATOR_HD CellRates<V> rates_with_eddies(const LatticeRates& rates, V inverse, V xx, V yy, V zz, V xy, V xz, V yz) {
    const V mean = (xx + yy + zz) * (1.0f / 3);
    xx -= mean, yy -= mean, zz -= mean;
    const V stress = square_root(xx * xx + yy * yy + zz * zz + 2.0f * (xy * xy + xz * xz + yz * yz));
    const float time = rates.slack + 0.5f;  // 1/w without eddies
    const V more = rates.eddies * stress * inverse;
    const V slack = rates.slack + quotient(0.5f * more, time + square_root(time * time + more));
    const V shear = quotient(slack - 0.5f, slack + 0.5f);
    return {shear, rates.trace, -shear};  // as lattice_rates has them
}

/// Raw moments of populations.
template <class V>
NATATOR_HD void moments_of(const V (&f)[lattice_populations], V (&m)[lattice_moments]) {
    V s0[9], s1[9], s2[9];  // sums along x of f, cx f, cx^2 f
    for (int e = 0; e < 9; ++e) {
        s2[e] = f[3 * e + 2] + f[3 * e];
        s1[e] = f[3 * e + 2] - f[3 * e];
        s0[e] = s2[e] + f[3 * e + 1];
    }
    const V zl = s0[0] + s0[1] + s0[2], zm = s0[3] + s0[4] + s0[5], zh = s0[6] + s0[7] + s0[8];
    const V yl = s0[0] + s0[3] + s0[6], yh = s0[2] + s0[5] + s0[8];
    const V pl = s1[0] + s1[1] + s1[2], pm = s1[3] + s1[4] + s1[5], ph = s1[6] + s1[7] + s1[8];
    const V ql = s1[0] + s1[3] + s1[6], qh = s1[2] + s1[5] + s1[8];
    m[0] = zl + zm + zh;
    m[1] = pl + pm + ph;
    m[2] = yh - yl;
    m[3] = zh - zl;
    m[4] = ((s2[0] + s2[1]) + (s2[2] + s2[3])) + ((s2[4] + s2[5]) + (s2[6] + s2[7])) + s2[8];
    m[5] = yh + yl;
    m[6] = zh + zl;
    m[7] = qh - ql;
    m[8] = ph - pl;
    m[9] = (s0[8] - s0[2]) - (s0[6] - s0[0]);
    m[10] = (s2[2] + s2[5] + s2[8]) - (s2[0] + s2[3] + s2[6]);
    m[11] = (s2[6] + s2[7] + s2[8]) - (s2[0] + s2[1] + s2[2]);
    m[12] = ql + qh;
    m[13] = (s0[6] + s0[8]) - (s0[0] + s0[2]);
    m[14] = pl + ph;
    m[15] = (s0[2] + s0[8]) - (s0[0] + s0[6]);
    m[16] = (s1[8] - s1[2]) - (s1[6] - s1[0]);
}

/// The part of water in equilibrium that goes by c along an axis along which it moves at u.
NATATOR_HD float moving_part(int c, float u) {
    const float square = u * u;
    return c == 0 ? 2.0f / 3 - square : 0.5f * (1.0f / 3 + square + (c > 0 ? u : -u));
}
/// Population i of water in equilibrium that moves at u with the density at rest, less that of water at rest.
NATATOR_HD float moving_population(int i, const float (&u)[3]) {
    float product = 1, rest = 1;
    for (int a = 0; a < 3; ++a) {
        product *= moving_part(along(i, a), u[a]);
        rest *= along(i, a) == 0 ? 2.0f / 3 : 1.0f / 6;
    }
    return product - rest;
}
/// All of them.
NATATOR_HD void moving_populations(const float (&u)[3], float (&f)[lattice_populations]) {
    float parts[3][3];
    for (int a = 0; a < 3; ++a)
        for (int k = 0; k < 3; ++k) parts[a][k] = moving_part(k - 1, u[a]);
    constexpr float rest[3] = {1.0f / 6, 2.0f / 3, 1.0f / 6};
    for (int i = 0; i < lattice_populations; ++i)
        f[i] = parts[0][i % 3] * parts[1][i / 3 % 3] * parts[2][i / 9] - rest[i % 3] * rest[i / 3 % 3] * rest[i / 9];
}
/// What a cell of a body that moves at u gets along an axis, or all of them, from a neighbour of water in a step: `in`,
/// what streams in by c, and `out`, what streams out by -c, less what both have in water that moves with the body.
template <class V>
NATATOR_HD V link_push(float in, float out, V c, V u) {
    return in * (c - u) + out * (c + u);
}

/// Central moments 0, 1, 2 about u along one axis to populations -1, 0, 1 along it; `rest`: what water at rest has.
template <class V, class W>
NATATOR_HD void populations_of_line(V k0, V k1, V k2, V u, W rest, V& minus, V& none, V& plus) {
    const V us = u * (k0 + rest), m1 = k1 + us, m2 = k2 + u * (k1 + m1);
    none = k0 - m2;
    plus = 0.5f * (m2 + m1);
    minus = 0.5f * (m2 - m1);
}

/// A third cumulant after a collision: small ones keep `keep` of themselves, those well above 0.1 nothing (Geier,
/// Pasquali, Schönherr: Parametrization of the cumulant lattice Boltzmann method for fourth order accurate diffusion,
/// 2017, eq. 119).
template <class V, class Keep>
NATATOR_HD V limited(V t, Keep keep) {
    const V size = t < 0.0f ? -t : t;
    return quotient(keep * t * 0.1f, 0.1f + size);
}

/// Collision by cumulants (Geier, Schönherr, Pasquali, Krafczyk: The cumulant lattice Boltzmann equation in three
/// dimensions, 2015), after which the water moves at u: populations are made about it, which is where forces act.
/// `put(i, f)` gets each population less that of water at rest. `eddies`: whether the rates have any.
template <bool eddies, class V, class Put>
NATATOR_HD void collide(const V (&m)[lattice_moments], V ux, V uy, V uz, const LatticeRates& all, const Put& put) {
    constexpr float third = 1.0f / 3, ninth = 1.0f / 9;
    const V r = m[0], rho = r + 1.0f, ir = 1.0f / rho, jx = m[1], jy = m[2], jz = m[3];
    const V ox = jx * ir, oy = jy * ir, oz = jz * ir, r3 = r * third, rho3 = rho * third;
    V xx = m[4] - r3 - jx * ox, yy = m[5] - r3 - jy * oy, zz = m[6] - r3 - jz * oz;
    V xy = m[7] - jx * oy, xz = m[8] - jx * oz, yz = m[9] - jy * oz;
    const auto rates = [&] {
        if constexpr (eddies)
            return rates_with_eddies(all, ir, xx, yy, zz, xy, xz, yz);
        else
            return all;
    }();
    const V a0 = rho3 + xx, b0 = rho3 + yy, c0 = rho3 + zz;
    const V xxy = limited(m[10] - 2.0f * ox * xy - oy * a0 - jx * ox * oy, rates.third);
    const V xxz = limited(m[11] - 2.0f * ox * xz - oz * a0 - jx * ox * oz, rates.third);
    const V xyy = limited(m[12] - 2.0f * oy * xy - ox * b0 - jy * oy * ox, rates.third);
    const V yyz = limited(m[13] - 2.0f * oy * yz - oz * b0 - jy * oy * oz, rates.third);
    const V xzz = limited(m[14] - 2.0f * oz * xz - ox * c0 - jz * oz * ox, rates.third);
    const V yzz = limited(m[15] - 2.0f * oz * yz - oy * c0 - jz * oz * oy, rates.third);
    const V xyz = limited(m[16] - ox * yz - oy * xz - oz * xy - jx * oy * oz, rates.third);
    xy *= rates.shear, xz *= rates.shear, yz *= rates.shear;
    const V trace = xx + yy + zz, mean = trace * third, kept = rates.trace * mean;
    xx = rates.shear * (xx - mean) + kept;
    yy = rates.shear * (yy - mean) + kept;
    zz = rates.shear * (zz - mean) + kept;
    // Central moments of fourth order and above of cumulants that are 0.
    const V k200 = r3 + xx, k020 = r3 + yy, k002 = r3 + zz, r9 = r * ninth;
    const V k220 = r9 + (xx + yy) * third + (xx * yy + 2.0f * xy * xy) * ir;
    const V k202 = r9 + (xx + zz) * third + (xx * zz + 2.0f * xz * xz) * ir;
    const V k022 = r9 + (yy + zz) * third + (yy * zz + 2.0f * yz * yz) * ir;
    const V k211 = yz * third + (xx * yz + 2.0f * xy * xz) * ir;
    const V k121 = xz * third + (yy * xz + 2.0f * xy * yz) * ir;
    const V k112 = xy * third + (zz * xy + 2.0f * xz * yz) * ir;
    const V k222 = r * (1.0f / 27) + (xx + yy + zz) * ninth +
                   (xx * yy + xx * zz + yy * zz + 2.0f * (xy * xy + xz * xz + yz * yz)) * third * ir +
                   (xx * yy * zz + 2.0f * (xx * yz * yz + yy * xz * xz + zz * xy * xy) + 8.0f * xy * xz * yz) * ir * ir;
    const V q200 = rho3 + xx, q020 = rho3 + yy, q002 = rho3 + zz;
    const V k221 = (q200 * yyz + q020 * xxz + 4.0f * xy * xyz + 2.0f * (xz * xyy + yz * xxy)) * ir;
    const V k212 = (q200 * yzz + q002 * xxy + 4.0f * xz * xyz + 2.0f * (xy * xzz + yz * xxz)) * ir;
    const V k122 = (q020 * xzz + q002 * xyy + 4.0f * yz * xyz + 2.0f * (xy * yzz + xz * yyz)) * ir;
    const V none{};
    V a[3][3][3];  // [order along z][order along y][population along x]
    const auto along_x = [&](V k0, V k1, V k2, float rest, V(&to)[3]) {
        populations_of_line(k0, k1, k2, ux, rest, to[0], to[1], to[2]);
    };
    along_x(r, none, k200, 1, a[0][0]);
    along_x(none, xy, xxy, 0, a[0][1]);
    along_x(none, xz, xxz, 0, a[1][0]);
    along_x(yz, xyz, k211, 0, a[1][1]);
    along_x(k020, xyy, k220, third, a[0][2]);
    along_x(k002, xzz, k202, third, a[2][0]);
    along_x(yyz, k121, k221, 0, a[1][2]);
    along_x(yzz, k112, k212, 0, a[2][1]);
    along_x(k022, k122, k222, ninth, a[2][2]);
    constexpr float w[3] = {1.0f / 6, 2.0f / 3, 1.0f / 6};
#if defined(__CUDA_ARCH__)
#pragma unroll
#endif
    for (int cx = 0; cx < 3; ++cx) {
        V b[3][3];  // [order along z][population along y]
        for (int z = 0; z < 3; ++z)
            populations_of_line(a[z][0][cx], a[z][1][cx], a[z][2][cx], uy,
                                z == 1   ? 0
                                : z == 0 ? w[cx]
                                         : w[cx] * third,
                                b[z][0], b[z][1], b[z][2]);
        for (int cy = 0; cy < 3; ++cy) {
            V f[3];
            populations_of_line(b[0][cy], b[1][cy], b[2][cy], uz, w[cx] * w[cy], f[0], f[1], f[2]);
            for (int cz = 0; cz < 3; ++cz) put(cx + 3 * cy + 9 * cz, f[cz]);
        }
    }
}

}  // namespace NATATOR_SET
}  // namespace natator::physics
