// The fluid of scheme `conserving`: Macklin, Müller: Position Based Fluids (2013), eq. 1-12, with inverse masses w and
// a constraint C_i = rho_i / rho0 - 1 <= 0 that only pushes. Density and gradient come from one kernel, (1 - q)^3 with
// q = r/R: with poly6 for the density, as the paper has it, pairs that have come close are pushed apart without the
// density ever falling, substep after substep. Sums over fluid neighbours j of a particle i, left = 1 - q.
#pragma once

#include "pair.h"

namespace natator::physics::inline NATATOR_SET {

/// What planes and solids add to C_i, to its gradient and to sum_k w_k |grad_k C_i|^2.
template <class T>
struct Boundary {
    T density{};
    Vec3<T> gradient{};
    T square{};
};

template <class R>
struct FluidKernel {
    R scale;           ///< A: W(r)/rho0 = A (1 - q)^3
    R gradient_scale;  ///< B: |grad W(r)|/rho0 = B (1 - q)^2
    R rest_sum;        ///< sum of (1 - q)^3 over the neighbours in the rest packing
};

/// grad_i C_i and sum_k w_k |grad_k C_i|^2, without B.
template <class T>
struct GradientSums {
    Vec3<T> gradient{};
    T square{};

    /// g = (1 - q)^2, slope = g / r.
    NATATOR_HD void add(T g, T slope, T inverse_mass, const Vec3<T>& difference) {
        gradient -= slope * difference;
        square += inverse_mass * g * g;
    }
    /// 1 / (w_i |grad_i C_i|^2 + sum_k w_k |grad_k C_i|^2), or 0 where all neighbours are where the kernel ends.
    template <class R>
    NATATOR_HD T response(T inverse_mass, R gradient_scale, const Vec3<T>& boundary_gradient, T boundary_square) const {
        const Vec3<T> c = gradient_scale * gradient + boundary_gradient;
        const T all = inverse_mass * squared_length(c) + (gradient_scale * gradient_scale * square + boundary_square);
        return all > R(least_response) ? 1 / all : T{};
    }
};

/// C_i, which rounds less than rho_i - 1, and its response; lambda_i = -max(C_i, 0) response.
template <class T>
struct LambdaSums {
    T sum{};
    GradientSums<T> gradients{};

    NATATOR_HD void add(const Vec3<T>& difference, const Distance<T>& distance, T left, T inverse_mass) {
        const T t = positive_part(left), g = t * t;
        sum += g * t;
        gradients.add(g, g * distance.inverse_r, inverse_mass, difference);
    }
    template <class R>
    NATATOR_HD T above_rest(const FluidKernel<R>& kernel, T boundary) const {
        return kernel.scale * (sum - kernel.rest_sum) + boundary;
    }
};

/// Dx_i = w_i / rho0 sum of (lambda_i + lambda_j) grad_i W_ij: equal and opposite in m Dx. Without w_i B.
template <class T>
struct PressurePush {
    Vec3<T> sum{};

    NATATOR_HD void add(const Vec3<T>& difference, const Distance<T>& distance, T left, T lambdas) {
        const T t = positive_part(left);
        sum -= lambdas * t * t * distance.inverse_r * difference;
    }
};

/// The velocity constraint of Bender, Koschier: Divergence-Free SPH (2015), eq. 8-10: lambda_i of the rate of change of
/// C_i, for particles that were under pressure: what takes it to 0, but at most what the pressure gave (times 1/h), so
/// that neighbours are never pulled together.
template <class T>
struct RateSums {
    T rate{};
    GradientSums<T> gradients{};

    NATATOR_HD void add(const Vec3<T>& difference, const Distance<T>& distance, T left, T inverse_mass,
                        const Vec3<T>& relative_velocity) {
        const T t = positive_part(left), g = t * t, slope = g * distance.inverse_r;
        rate += slope * dot(relative_velocity, difference);
        gradients.add(g, slope, inverse_mass, difference);
    }
    /// `most` = -(sum of the substep's lambdas) / h.
    template <class R>
    NATATOR_HD T lambda(R gradient_scale, T response, T most) const {
        const T wanted = -gradient_scale * rate * response;
        const T limited = smaller(most, wanted);
        return most > 0 ? limited : T{};
    }
};

/// Viscosity: A sum of (1 - q^2)^3 2 w_i / (w_i + w_j) (u_j - u_i), equal and opposite momenta per pair. Without A.
template <class T>
struct PairwiseSmoothing {
    Vec3<T> sum{};

    template <class R>
    NATATOR_HD void add(const Vec3<T>& difference, R inverse_radius, T own, T other, const Vec3<T>& relative_velocity) {
        const T t = positive_part(1 - squared_length(difference) * (inverse_radius * inverse_radius));
        sum += t * t * t * 2 * own / (own + other + R(least_square)) * relative_velocity;
    }
};

/// 1 - q and B (1 - q)^2 of a solid particle in the density of the fluid around it, which it counts in with weight
/// solidPressure, like a fluid particle in value and gradient; other than in scheme `flex` it takes the reaction:
/// returns grad_i C_i / difference, to be weighted.
template <class T>
NATATOR_HD void add_solid(Boundary<T>& boundary, const Vec3<T>& difference, T inverse_radius, T weight,
                          const FluidKernel<T>& kernel, T inverse_mass) {
    const T r = norm(difference), left = 1 - r * inverse_radius;
    if (!(left > 0)) return;
    const T slope = weight * kernel.gradient_scale * left * left;
    boundary.density += weight * kernel.scale * left * left * left;
    if (r > 0) boundary.gradient -= slope / r * difference;
    boundary.square += inverse_mass * slope * slope;
}

/// What the contact of a fluid particle, whose constraint has `lambda`, and a solid pushes the one at `difference` from
/// the other by, per inverse mass: -lambda |grad C| n.
template <class T>
NATATOR_HD Vec3<T> solid_pressure_push(const Vec3<T>& difference, T inverse_radius, T weighted_gradient_scale,
                                       T lambda) {
    const T r = norm(difference), left = 1 - r * inverse_radius;
    if (!(left > 0) || !(r > 0)) return {};
    return -lambda * (weighted_gradient_scale * left * left) / r * difference;
}

/// lambda_i of a particle that began the substep with C_i = C0 > 0 too dense: what takes C_i back to C0 acts in full,
/// what takes it from C0 to 0 up to the lambda that moves a pair by `push` = a h^2 / (1 + C0)^(1/3) at most, so that
/// the pressure grows little with the number of pairs; `given` has what has done so in this substep.
template <class T>
NATATOR_HD T limited_lambda(T above_rest, T response, T at_start, T push, T inverse_mass, T gradient_scale, T& given) {
    const T above = positive_part(above_rest);
    if (!(at_start > 0) || !(inverse_mass > 0)) return -above * response;
    const T most = push / (inverse_mass * gradient_scale * cube_root(1 + at_start));
    const T now = smaller(smaller(above, at_start) * response, positive_part(most - given));
    given += now;
    return -(positive_part(above - at_start) * response + now);
}

}  // namespace natator::physics::inline NATATOR_SET
