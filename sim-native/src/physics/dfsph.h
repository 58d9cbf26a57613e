// The water of scheme `conserving`: incompressible SPH by two pressure solves a substep (Bender, Koschier:
// Divergence-Free SPH for Incompressible and Viscous Fluids, 2017), with the kernel C2 of Wendland (1995), and with
// gradients corrected to be exact for linear fields (Bonet, Lok: Variational and momentum preservation aspects of SPH,
// 1999, eq. 47-49). A pair takes the mean of its two corrections: its forces stay equal and opposite, and it is nearly
// as exact. Sums run over the neighbours j of a particle i, difference = x_i - x_j, R the kernel's support. V is a
// particle's volume; density is the sum of V W, 1 at rest, whatever the particles weigh.
#pragma once

#include "pair.h"
#include "symmetric3.h"

namespace natator::physics::inline NATATOR_SET {

/// Wendland's C2 in space: W(q) = sigma (1 - q)^4 (4 q + 1), q = r/R, sigma = 21 / (2 pi R^3).
template <class R>
struct WendlandKernel {
    R inverse_radius;
    R scale;        ///< sigma
    R slope_scale;  ///< 20 sigma / R^2

    template <class T>
    NATATOR_HD T value(T r) const {
        const T q = r * inverse_radius, t = positive_part(1 - q), square = t * t;
        return scale * square * square * (4 * q + 1);
    }
    /// -W'(r) / r, so that grad_i W = -slope difference.
    template <class T>
    NATATOR_HD T slope(T r) const {
        const T t = positive_part(1 - r * inverse_radius);
        return slope_scale * t * t * t;
    }
};

template <class R>
NATATOR_HD WendlandKernel<R> wendland_kernel(R radius, R scale) {
    return {1 / radius, scale, 20 * scale / (radius * radius)};
}

/// A number cut to [0, 1].
template <class T>
NATATOR_HD T unit_part(T v) {
    return minimum(positive_part(v), one<T>());
}

// The numbers of the method. What each changes: results/water/README.md#what-each-constant-changes.
inline constexpr double wet_density = 0.9;  ///< from which a particle is held incompressible, of rest density
inline constexpr double jacobi_relaxation = 0.5;
inline constexpr double max_excess = 0.05;  ///< of rest density that the velocities take off in a substep
inline constexpr double expansion = 0.25;   ///< rate at which velocities take it off, times sqrt(s / g)
/// depth in rest distances beyond which that rate falls, with the square of the depth
inline constexpr double shallow_layers = 40;
inline constexpr double min_expansion = 0.1;   ///< the least rate, times sqrt(s / g)
inline constexpr double max_overlap = 0.5;     ///< of rest density that a substep separates without velocities
inline constexpr int separation_passes = 4;    ///< over overlaps, in a substep
inline constexpr double max_separation = 0.5;  ///< of the rest distance, a substep
inline constexpr double max_diffusion = 0.1;  ///< of nu h / s^2, nu = dynamic viscosity / a particle's own mass density
/// of the viscosity between water and solids, see wall_viscosity_factor
inline constexpr double surface_wall_viscosity_factor = 1.63;
inline constexpr double shift_strength = 0.5;    ///< of R h |dv| times where neighbours crowd
inline constexpr double max_shift = 0.05;        ///< of the rest distance, a substep
inline constexpr double shifted_density = 0.95;  ///< below it is the surface, which is left as it is
inline constexpr double partly_corrected_density = 0.9, wholly_corrected_density = 0.95;
/// of a fluid's density times the square of its fastest neighbour's velocity
inline constexpr double uncorrected_pressure = 30;
/// of the rest distance: nearer, the kernel no longer parts a particle and its ghost
inline constexpr double min_wall_distance = 0.3;

// How far gradients are corrected: in full at this density and this determinant of the moments, not at all at half the
// determinant or the lower density. Near a free surface half of the neighbours lack, and the inverse is
// ill-conditioned.
inline constexpr double corrected_density = 0.7, uncorrected_density = 0.5;
inline constexpr double corrected_determinant = 0.4, uncorrected_determinant = 0.2;

/// Density, first moments of the kernel's gradient, and the way out of where neighbours crowd (particle shifting: Lind,
/// Xu, Stansby, Rogers, 2012).
template <class T>
struct MomentSums {
    T density{};
    Symmetric3<T> moments{};
    Vec3<T> crowding{};

    /// `at_spacing`: 1 / W at the rest spacing. The factor 1 + 0.2 (W / W(s))^4 of the crowding is Monaghan's (2000)
    /// against pairs that clump.
    template <class R>
    NATATOR_HD void add(const Vec3<T>& difference, const WendlandKernel<R>& kernel, R at_spacing, T volume) {
        const T r = length_of(difference);
        const T value = kernel.value(r), weight = volume * kernel.slope(r);
        density += volume * value;
        moments.xx += weight * difference.x * difference.x;
        moments.yy += weight * difference.y * difference.y;
        moments.zz += weight * difference.z * difference.z;
        moments.xy += weight * difference.x * difference.y;
        moments.xz += weight * difference.x * difference.z;
        moments.yz += weight * difference.y * difference.z;
        const T close = value * at_spacing, square = close * close;
        crowding += weight * (1 + R(0.2) * square * square) * difference;
    }

    /// L_i: the inverse of the moments, blended into the identity where too many neighbours lack.
    NATATOR_HD Symmetric3<T> correction(T whole_density) const {
        using R = Scalar<T>;
        const Symmetric3<T>& m = moments;
        const T a = m.yy * m.zz - m.yz * m.yz, b = m.xz * m.yz - m.xy * m.zz, c = m.xy * m.yz - m.xz * m.yy;
        const T determinant = m.xx * a + m.xy * b + m.xz * c;
        const T by_density =
            unit_part((whole_density - R(uncorrected_density)) * R(1 / (corrected_density - uncorrected_density)));
        const T by_determinant = unit_part((determinant - R(uncorrected_determinant)) *
                                           R(1 / (corrected_determinant - uncorrected_determinant)));
        const T blend = by_density * by_determinant;
        const T inverse =
            blend / (positive_part(determinant - R(uncorrected_determinant)) + R(uncorrected_determinant));
        const T rest = 1 - blend;
        return {inverse * a + rest,
                inverse * (m.xx * m.zz - m.xz * m.xz) + rest,
                inverse * (m.xx * m.yy - m.xy * m.xy) + rest,
                inverse * b,
                inverse * c,
                inverse * (m.xy * m.xz - m.xx * m.yz)};
    }
};

/// Largest speed of neighbours relative to a particle.
template <class T>
struct PassingSpeed {
    T square{};  ///< largest |v_j - v_i|^2

    /// `weight`: the neighbour's volume times the kernel's slope; what ends a list has none.
    NATATOR_HD void add(const Vec3<T>& relative_velocity, T weight) {
        const T its_square = dot_unfused(relative_velocity, relative_velocity);
        const T counted = weight > 0 ? its_square : T{};
        square = minimum(-square, -counted) * Scalar<T>(-1);
    }
};

/// G_ij = V_i V_j (L_i + L_j)/2 grad_i W: sum_j (v_j - v_i) G_ij is V_i times the divergence of v at i. `slope`: of the
/// kernel.
template <class T>
NATATOR_HD Vec3<T> pair_gradient(const Vec3<T>& difference, T slope, T volumes, const Symmetric3<T>& both) {
    return (Scalar<T>(-0.5) * volumes * slope) * (both * difference);
}

/// Sums over all G_ij of a particle: the change of its rate of expansion per unit of its pressure impulse.
template <class T>
struct ResponseSums {
    Vec3<T> gradient{};
    T square{};

    NATATOR_HD void add(const Vec3<T>& pair_gradient, T other_inverse_mass) {
        gradient += pair_gradient;
        square += other_inverse_mass * dot_unfused(pair_gradient, pair_gradient);
    }
    /// 1 / (w_i |sum G_ij|^2 + sum w_j |G_ij|^2), or 0 without neighbours; DFSPH's alpha.
    NATATOR_HD T response(T inverse_mass) const {
        using R = Scalar<T>;
        const T all = inverse_mass * dot(gradient, gradient) + square;
        return all > R(min_response) ? 1 / all : T{};
    }
};

/// Mobility of a particle under a push: its inverse mass. One that is held counts as water in the pressure solve: next
/// to nothing but held ones the pressure would have no bound. `fluid_density`: mass/length^3, 0 without water that
/// moves.
template <class T>
NATATOR_HD T mobility(T inverse_mass, T volume, T fluid_density) {
    return inverse_mass > 0 || !(fluid_density > 0) ? inverse_mass : 1 / (fluid_density * volume);
}

/// The largest excess of density that velocities may remove in a substep of length h.
template <class T>
NATATOR_HD T velocity_limit(T h, T max_expansion_rate) {
    return minimum(T(max_excess), h * max_expansion_rate);
}

/// The excess of density that the velocities remove in a substep; negative below rest density. The speed that this
/// gives does not leave again, so it is no more than `limit`, a velocity_limit.
template <class T>
NATATOR_HD T velocity_excess(T density, Scalar<T> limit) {
    return minimum(density - 1, T{} + limit);
}

/// The rate of expansion, times V_i, that a density solve goes for: what takes a particle to rest density in a substep.
template <class T>
NATATOR_HD T density_target(T volume, T density, Scalar<T> limit, Scalar<T> h) {
    return volume / h * velocity_excess(density, limit);
}

/// The same of the rest of an overlap. It is parted by passes on velocities that begin at 0 and are forgotten once they
/// have moved the particles (split impulses: Guendelman, Bridson, Fedkiw: Nonconvex Rigid Bodies with Stacking, 2003,
/// and others).
template <class T>
NATATOR_HD T separation_target(T volume, T density, Scalar<T> limit, Scalar<T> h) {
    const T above = minimum(density - 1, T{} + Scalar<T>(max_overlap));
    return volume / h * positive_part(above - velocity_excess(density, limit));
}

/// Pressure impulse of a Jacobi pass: takes a rate of expansion below its target there, never above.
template <class T>
NATATOR_HD T pressure_impulse(T target, T rate, T response, T density) {
    using R = Scalar<T>;
    const T all = R(jacobi_relaxation) * positive_part(target - rate) * response;
    return density > R(wet_density) ? all : T{};
}

/// The factor of uncorrected_impulse in a substep of length h, s. `fluid_density`: mass/length^3.
template <class T>
NATATOR_HD T uncorrected_strength(T h, T fluid_density) {
    return T(uncorrected_pressure) * h * fluid_density;
}

/// The pressure impulse that a particle may have before zeroth_order_correction sets in. `strength`: see
/// uncorrected_strength.
template <class T>
NATATOR_HD T uncorrected_impulse(T max_speed_square, Scalar<T> strength) {
    return strength * max_speed_square;
}

/// Impulse subtracted from a particle's own pressure push, in units of sum_j G_ij.
///
/// That sum should be 0 but is not where neighbours lie unevenly, and then the pressure p that a particle has in common
/// with its neighbours pushes it by -2 p sum_j G_ij, to where they lie less densely. This is what keeps particles
/// apart, and also what makes them a packing of grains: it resists slow shear by a stress in proportion to p, like
/// sand. So only as much of p is left to it as particles need that pass one another as fast as they do here. The rest,
/// E_i = zeroth_order_correction sum_j G_ij, is taken off after each pass and given back at the end of the substep to
/// all neighbours by their kernels' weights, which keeps the momentum. (Without any of it, as in the form p_j - p_i of
/// many schemes, particles crowd, and need strong shifting.)
///
/// Where nearly all neighbours are on one side, at a crowded surface, zeroth_order_correction in full turns a push
/// around: what it does to the particle itself, -w |sum_j G_ij|^2, outweighs what it does to the neighbours, so each
/// pass makes the next one larger, without end. `own_response`, see own_response(), says how far that is so, and as
/// much of the push is left as keeps half of the response.
template <class T>
NATATOR_HD T zeroth_order_correction(T density, T impulse_sum, T kept, T own_response) {
    using R = Scalar<T>;
    const T wet = unit_part((density - R(partly_corrected_density)) *
                            R(1 / (wholly_corrected_density - partly_corrected_density)));
    const T stable = 1 + R(0.5) * (1 - own_response) / (own_response + R(min_response));
    return minimum(2 * wet * positive_part(impulse_sum - kept), stable * impulse_sum);
}

/// The part that a particle's own motion has in its response to its pressure, in [0, 1]; `response`: see ResponseSums.
template <class T>
NATATOR_HD T own_response(T inverse_mass, const Vec3<T>& gradient_sum, T response) {
    return minimum(inverse_mass * dot(gradient_sum, gradient_sum) * response, one<T>());
}

/// The part of E_j that a neighbour at distance r has back is this times V_i W_ij: those parts add up to E_j.
template <class T, class R>
NATATOR_HD T zeroth_order_share(T density, T volume, const WendlandKernel<R>& kernel) {
    const T others = density - volume * kernel.scale;
    return others > 0 ? 1 / others : T{};
}

/// Pressure impulse of a ghost beyond its owner's: the weight of the water between them, as dp/dn = rho g n at a wall,
/// at most as much as the owner's. The pressure of ghosts has a kink at the wall, of which gradients see but a part:
/// what lies on a floor would go on falling. `own`, `volume`: the owner's inverse mass and volume; `to_ghost`: from
/// owner to ghost.
template <class T>
NATATOR_HD T hydrostatic_ghost_impulse(T own, T volume, T h, const Vec3<T>& gravity, const Vec3<T>& to_ghost,
                                       T impulse) {
    if (!(own > 0)) return T{};
    const T weight = h / (own * volume) * dot_unfused(gravity, to_ghost);
    return minimum(-minimum(-weight, impulse), impulse);
}

/// Displacement in a substep that keeps particles of the fluid evenly spread, length; no velocity comes with it.
template <class T>
NATATOR_HD Vec3<T> shift_of(T density, const Vec3<T>& crowding, T max_speed_square, T radius, T spacing, T h) {
    if (!(density > T(shifted_density))) return {};
    const T strength = T(shift_strength) * radius * h * square_root(max_speed_square);
    return clamped(strength * crowding, T(max_shift) * spacing);
}

/// The largest kinematic viscosity that an explicit step of h bears between particles `spacing` apart, length^2/s.
NATATOR_HD double max_viscosity(double spacing, double h) {
    return max_diffusion * spacing * spacing / h;
}

/// 10 h mu, of viscous impulses in a substep of length h. `viscosity`: dynamic, mass/(length s).
template <class T>
NATATOR_HD T viscous_strength(T h, T viscosity) {
    return 10 * h * viscosity;
}

/// Softening that keeps viscous impulses finite between particles at one place, length^2.
template <class T>
NATATOR_HD T viscous_softening(T spacing) {
    return T(0.01) * spacing * spacing;
}

/// The most that a particle's volume times its inverse mass may be where viscous impulses are 10 h mu = `strength`.
template <class T>
NATATOR_HD T viscous_limit(T spacing, T strength) {
    return 10 * T(max_diffusion) * spacing * spacing / strength;
}

/// The part of a pair's viscosity that an explicit step of it bears: all of it unless one of the two is so light that
/// it would overshoot. `own`, `other`: a particle's volume times its inverse mass; `limit`: what that may be.
template <class T>
NATATOR_HD T viscous_share(T own, T other, Scalar<T> limit) {
    const T larger = minimum(-own, -other) * Scalar<T>(-1);
    return larger > limit ? limit / larger : one<T>();
}

/// Factor of the viscosity of a pair of which one is water, the other solid. 1 for a solid, 0 for water.
///
/// The water's velocity falls to a body's at its surface, but all of a body's particles have the body's velocity, those
/// deep in it too, where the water's gradient would go on: what they should pull by is lost. With plain pairs, water
/// that flows along a body is at rest 0.32 spacings deep in it (the extrapolated end point of Milne's problem for the
/// weights of ViscousSums over 2.5 spacings); with pairs so much stronger it is at rest at the surface. Morris, Fox,
/// Zhu (Modeling Low Reynolds Number Incompressible Flows Using SPH, 1997) make the difference of velocities of such a
/// pair up to 1.5 times larger, to the same end.
template <class T>
NATATOR_HD T wall_viscosity_factor(T own_solid, T other_solid) {
    const T differ = own_solid - other_solid;
    return 1 + Scalar<T>(surface_wall_viscosity_factor - 1) * differ * differ;
}

/// Viscous impulses on a particle, without its inverse mass and 10 h mu: Monaghan's form (2005, eq. 8.5), which acts
/// along the pair and so keeps angular momentum up to the correction of G. `softening` is viscous_softening; `share`
/// is viscous_share times wall_viscosity_factor.
template <class T>
struct ViscousSums {
    Vec3<T> impulse{};

    NATATOR_HD void add(const Vec3<T>& difference, const Vec3<T>& relative_velocity, Scalar<T> softening, T share,
                        const Vec3<T>& pair_gradient) {
        const T approach = dot_unfused(relative_velocity, difference);  // (v_j - v_i) (x_i - x_j)
        impulse -= share * approach / (squared_length(difference) + softening) * pair_gradient;
    }
};

}  // namespace natator::physics::inline NATATOR_SET
