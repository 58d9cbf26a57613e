#include <algorithm>

#include "../rest_packing.h"
#include "physics/constants.h"
#include "cohesion_spline.h"
#include "fluid_neighbours.h"

namespace natator::cpu {
namespace {

/// G of the estimate grad f_i = G/R sum over j of (f_j - f_i) (1 - q) (x_j - x_i)/r, exact for a linear f in the rest
/// packing, because that looks the same along all axes.
double gradient_scale(const SolverParameters& p) {
    return 3 / rest_packing_sum(p.fluidRestDistance / p.radius, [](double q) { return (1 - q) * q; });
}

/// Part of a pair's force that goes to particle i: 2 w_i / (w_i + w_j), so that w is an inverse mass and the pair's two
/// impulses are equal and opposite; 1 for equal masses.
template <class Real>
Real share(Real wi, Real wj) {
    return 2 * wi / (wi + wj);
}

}  // namespace

/// Akinci, Akinci, Teschner (2013), eq. 3-4: F_ij = -surfaceTension (n_i - n_j), n = R times the gradient of the colour
/// field, pointing outward here. Its size grows with curvature, so the force pulls bumps in. Masses enter by `share`.
template <class Real>
void Substep<Real>::add_surface_tension() {
    const Real scale = static_cast<Real>(gradient_scale(model_.parameters));
    const Real strength = static_cast<Real>(model_.parameters.surfaceTension);
    for (int slot = 0; slot < ws_.fluid; ++slot) {
        Vec3<Real> sum{};
        for_each_fluid_neighbour(
            slot, [&](int, const Vec3<Real>& difference, Real r, Real q) { sum += (1 - q) / r * difference; });
        normal_[slot] = scale * sum;
    }
    for (int slot = 0; slot < ws_.fluid; ++slot) {
        const Real w = ws_.inverse_mass[slot];
        if (w == 0) continue;
        Vec3<Real> sum{};
        for_each_fluid_neighbour(slot, [&](int other, const Vec3<Real>&, Real, Real) {
            sum += share(w, ws_.inverse_mass[other]) * (normal_[slot] - normal_[other]);
        });
        velocity_change_[ws_.particle_of[slot]] -= h_ * strength * sum;
    }
}

/// Macklin, Müller: Position Based Fluids (2013), eq. 15-16: omega_i = sum over j of (v_j - v_i) x grad_j W, then
/// a_i = vorticityConfinement N x omega_i, N the direction of grad |omega|. Momentum is not kept.
template <class Real>
void Substep<Real>::add_vorticity_confinement() {
    const Real scale = static_cast<Real>(gradient_scale(model_.parameters)) * constants_.inverse_radius;
    const Real strength = static_cast<Real>(model_.parameters.vorticityConfinement);
    for (int slot = 0; slot < ws_.fluid; ++slot) {
        const Vec3<Real> velocity = new_velocity_[ws_.particle_of[slot]];
        Vec3<Real> sum{};
        for_each_fluid_neighbour(slot, [&](int other, const Vec3<Real>& difference, Real r, Real q) {
            const Vec3<Real> relative = new_velocity_[ws_.particle_of[other]] - velocity;
            sum += (1 - q) / r * cross(relative, difference);
        });
        curl_[slot] = scale * sum;
    }
    for (int slot = 0; slot < ws_.fluid; ++slot) {
        const Real magnitude = norm(curl_[slot]);
        Vec3<Real> towards_stronger{};
        for_each_fluid_neighbour(slot, [&](int other, const Vec3<Real>& difference, Real r, Real q) {
            towards_stronger -= (norm(curl_[other]) - magnitude) * (1 - q) / r * difference;
        });
        const Real length = norm(towards_stronger);
        if (!(length > 0)) continue;
        velocity_change_[ws_.particle_of[slot]] += h_ * strength / length * cross(towards_stronger, curl_[slot]);
    }
}

/// The pull of CohesionSpline as a force, in units of R per h0^2, h0 = 1/240 s the substep of the thesis.
template <class Real>
void Substep<Real>::add_cohesion() {
    constexpr Real thesis_substep = static_cast<Real>(physics::thesis_substep);
    const CohesionSpline<Real> pull(model_.parameters);
    const Real strength = static_cast<Real>(model_.parameters.cohesion) * constants_.radius;
    const Real step = h_ / (thesis_substep * thesis_substep);
    for (int slot = 0; slot < ws_.fluid; ++slot) {
        const Real w = ws_.inverse_mass[slot];
        if (w == 0) continue;
        Vec3<Real> sum{};
        for_each_fluid_neighbour(slot, [&](int other, const Vec3<Real>& difference, Real r, Real q) {
            sum += share(w, ws_.inverse_mass[other]) * pull(q) / r * difference;
        });
        velocity_change_[ws_.particle_of[slot]] -= step * strength * sum;
    }
}

/// All from the same final positions and velocities.
template <class Real>
void Substep<Real>::apply_fluid_forces() {
    std::fill(velocity_change_.begin(), velocity_change_.end(), Vec3<Real>{});
    if (plan_.cohesion && model_.scheme == Scheme::conserving) add_cohesion();
    if (plan_.surface_tension) add_surface_tension();
    if (plan_.vorticity) add_vorticity_confinement();
    for (const int i : ws_.fluid_ids) {
        new_velocity_[i] += velocity_change_[i];
        if (plan_.clamp_speed) new_velocity_[i] = clamped(new_velocity_[i], constants_.max_speed);
    }
}

template void Substep<float>::apply_fluid_forces();
template void Substep<double>::apply_fluid_forces();

}  // namespace natator::cpu
