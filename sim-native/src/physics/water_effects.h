// Forces of effects.h in the water of scheme `conserving`, which has G_ij of every pair by then (see dfsph.h):
// gradients come from these, so that they are exact for linear fields, and walls and bodies are no surface. R is the
// lesser of interaction radius and kernel support, `own` and `other` are inverse masses, difference = x_i - x_j.
#pragma once

#include "effects.h"

namespace natator::physics::inline NATATOR_SET {

/// Change of i's velocity by the cohesion of a pair of fluid particles, without -cohesion R h / h0^2, h0 the thesis'
/// substep; see cohesion_pull.
template <class T>
NATATOR_HD Vec3<T> cohesion_part(const Vec3<T>& difference, T r, T inverse_radius, T slope, T own, T other) {
    return impulse_share(own, other) * cohesion_pull(r * inverse_radius, slope) / r * difference;
}

/// Change of i's velocity by the surface tension of a pair of fluid particles, without -surface_tension h; normals as
/// by colour_normal.
template <class T>
NATATOR_HD Vec3<T> tension_part(const Vec3<T>& normal, const Vec3<T>& other_normal, T own, T other) {
    return impulse_share(own, other) * (normal - other_normal);
}

/// n_i, R times the gradient of the colour field, outwards; from the sum of G_ij over all neighbours.
template <class T>
NATATOR_HD Vec3<T> colour_normal(const Vec3<T>& gradient_sum, T radius, T volume) {
    return -radius / volume * gradient_sum;
}

/// V_i times the vorticity at i, summed over all neighbours.
template <class T>
NATATOR_HD Vec3<T> vorticity_part(const Vec3<T>& relative_velocity, const Vec3<T>& pair_gradient) {
    return cross(pair_gradient, relative_velocity);
}

}  // namespace natator::physics::inline NATATOR_SET
