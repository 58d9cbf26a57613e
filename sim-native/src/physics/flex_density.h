// The fluid of scheme `flex` as NVIDIA Flex 1.2.0 was measured to compute it (tests/conformance): a density constraint
// without multiplier or masses, after Macklin, Müller: Position Based Fluids (2013), and a viscosity after Schechter,
// Bridson: Ghost SPH for Animating Water (2012), eq. 7. Sums over fluid neighbours j of a particle i, left = 1 - r/R.
#pragma once

#include "pair.h"

namespace natator::physics::inline NATATOR_SET {

/// rho_i = sum of W_ij / S + what solids add, W = (1 - r/R)^2, without the particle itself; 1/S = density_scale makes
/// that of the rest packing 1.
template <class T>
struct FlexDensity {
    T sum{};

    NATATOR_HD void add(T left) { add_positive_square(sum, left); }
    template <class R>
    NATATOR_HD T density(T solids, R density_scale) const {
        return (sum + solids) * density_scale;
    }
};

/// Dx_i = w_i R sum of 1/2 (C_i + C_j) (1 - r/R) n, C = max(rho - 1, 0), n from j to i. The weight is w_i itself, not a
/// share. Every neighbour with r < R is a constraint.
template <class T>
struct FlexPush {
    Vec3<T> sum{};
    T constraints{};

    NATATOR_HD void add(const Vec3<T>& difference, const Distance<T>& distance, T left, T compressions) {
        const T t = positive_part(left);
        add_product(sum, compressions * t * distance.inverse_r, difference);
        constraints = count_positive(constraints, t);
    }
    template <class R>
    NATATOR_HD Vec3<T> correction(T inverse_mass, R radius) const {
        return inverse_mass * radius * R(0.5) * sum;
    }
};

/// Du_i / (h viscosity) = sum of W_ij (u_j - u_i) / S.
template <class T>
struct FlexSmoothing {
    Vec3<T> sum{};

    NATATOR_HD void add(T left, const Vec3<T>& relative_velocity) {
        add_product(sum, positive_square(left), relative_velocity);
    }
};

}  // namespace natator::physics::inline NATATOR_SET
