// Forces and losses that the thesis leaves off. Sums are over fluid neighbours j of a particle i at distance r = q R,
// `difference` from j to i.
#pragma once

#include "constants.h"
#include "vec3.h"

namespace natator::physics::inline NATATOR_SET {

/// Pull between two fluid particles as a multiple of cohesion * R, negative where they are pushed apart:
///   f(q) = -1 + b q^2 - (b - 1) q^3, b = 1 + 1/s + 1/s^2, s = fluid_rest_distance / R,
/// the cubic with f(0) = -1, f'(0) = 0, f(s) = f(1) = 0. A spline along the line between two particles that pushes near
/// and pulls far as in Akinci, Akinci, Teschner: Versatile Surface Tension and Adhesion for SPH Fluids (2013), eq. 1-2;
/// its form is fitted to measurements of NVIDIA Flex (f_grid3_cohesion0.025_s0.08 in tests/conformance), to 2e-8.
NATATOR_HD double cohesion_slope(double s) {
    return 1 + 1 / s + 1 / (s * s);
}
template <class T>
NATATOR_HD T cohesion_pull(T q, T b) {
    return q * q * (b - (b - 1) * q) - 1;
}

/// Part of a pair's force that goes to particle i: 2 w_i / (w_i + w_j), so that w is an inverse mass and the pair's two
/// impulses are equal and opposite; 1 for equal masses.
template <class T>
NATATOR_HD T impulse_share(T own, T other) {
    return 2 * own / (own + other);
}

/// R grad f_i = G sum of this, `change` = f_i - f_j; exact for a linear f in the rest packing, because that
/// looks the same along all axes, with G = gradient_estimate. Of the colour field, which ends at the surface, change is
/// 1: the normal n of Akinci, Akinci, Teschner (2013), eq. 3-4. Their force F_ij = -surface_tension (n_i - n_j) grows
/// with curvature and pulls bumps in.
template <class T>
NATATOR_HD Vec3<T> gradient_part(T change, const Vec3<T>& difference, T r, T q) {
    return change * (1 - q) / r * difference;
}

/// Vorticity confinement, Macklin, Müller: Position Based Fluids (2013), eq. 15-16: omega_i = sum of (v_j - v_i) x
/// grad_j W, a_i = vorticity_confinement N x omega_i, N the direction of grad |omega|. Momentum is not kept.
template <class T>
NATATOR_HD Vec3<T> curl_part(const Vec3<T>& difference, T r, T q, const Vec3<T>& relative_velocity) {
    return (1 - q) / r * cross(relative_velocity, difference);
}
template <class T>
NATATOR_HD Vec3<T> confinement(const Vec3<T>& towards_stronger, const Vec3<T>& curl, T step) {
    const T length = norm(towards_stronger);
    return length > 0 ? step / length * cross(towards_stronger, curl) : Vec3<T>{};
}

/// Dissipation, implicitly, n = contacts closer than solid_rest_distance when predicted, step = h dissipation. Scheme
/// `flex`: v_i /= 1 + step max(n - 1, 0), a single contact was measured to do nothing (b_diss); what is taken off.
template <class T>
NATATOR_HD T dissipated(T contacts, T step) {
    const T counted = positive_part(contacts - 1);
    return step * counted / (1 + step * counted);
}
/// Scheme `conserving`: v_i += sum over contacts of impulse share * this * (v_j - v_i).
template <class T>
NATATOR_HD T dissipated_by_pair(T contacts_of_both, T step) {
    return step / (1 + step * contacts_of_both);
}

/// Free-surface drag dv/dt = -free_surface_drag max(1 - density, 0) v by implicit Euler, step = h free_surface_drag:
/// full drag for a particle alone, none where the fluid has its rest density.
template <class T>
NATATOR_HD Vec3<T> dragged(const Vec3<T>& v, T density, T step) {
    return v / (1 + step * positive_part(1 - density));
}

/// Adhesion: of the distance `left` by which a particle that touched a plane at the substep's start has left it, up to
/// `limit` = adhesion h^2 is taken back, so a steady pull is withstood if its acceleration is at most `adhesion`.
template <class T>
NATATOR_HD T taken_back(T left, T limit) {
    return minimum(positive_part(left), limit);
}

}  // namespace natator::physics::inline NATATOR_SET
