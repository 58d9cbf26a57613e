#include <algorithm>

#include "fluid_neighbours.h"
#include "physics/effects.h"

namespace natator::cpu {

/// Masses enter by impulse_share.
template <class Real>
void Substep<Real>::add_surface_tension() {
    const Real strength = static_cast<Real>(model_.parameters.surface_tension);
    for (int slot = 0; slot < ws_.fluid; ++slot) {
        Vec3<Real> sum{};
        for_each_fluid_neighbour(slot, [&](int, const Vec3<Real>& difference, Real r, Real q) {
            sum += physics::gradient_part(Real(1), difference, r, q);
        });
        normal_[slot] = constants_.gradient_estimate * sum;
    }
    for (int slot = 0; slot < ws_.fluid; ++slot) {
        const Real w = ws_.inverse_mass[slot];
        if (w == 0) continue;
        Vec3<Real> sum{};
        for_each_fluid_neighbour(slot, [&](int other, const Vec3<Real>&, Real, Real) {
            sum += physics::impulse_share(w, ws_.inverse_mass[other]) * (normal_[slot] - normal_[other]);
        });
        velocity_change_[ws_.particle_of[slot]] -= h_ * strength * sum;
    }
}

template <class Real>
void Substep<Real>::add_vorticity_confinement() {
    const Real scale = constants_.gradient_estimate * constants_.inverse_radius;
    const Real strength = static_cast<Real>(model_.parameters.vorticity_confinement);
    for (int slot = 0; slot < ws_.fluid; ++slot) {
        const Vec3<Real> velocity = new_velocity_[ws_.particle_of[slot]];
        Vec3<Real> sum{};
        for_each_fluid_neighbour(slot, [&](int other, const Vec3<Real>& difference, Real r, Real q) {
            sum += physics::curl_part(difference, r, q, new_velocity_[ws_.particle_of[other]] - velocity);
        });
        curl_[slot] = scale * sum;
    }
    for (int slot = 0; slot < ws_.fluid; ++slot) {
        const Real magnitude = norm(curl_[slot]);
        Vec3<Real> towards_stronger{};
        for_each_fluid_neighbour(slot, [&](int other, const Vec3<Real>& difference, Real r, Real q) {
            towards_stronger -= physics::gradient_part(norm(curl_[other]) - magnitude, difference, r, q);
        });
        velocity_change_[ws_.particle_of[slot]] += physics::confinement(towards_stronger, curl_[slot], h_ * strength);
    }
}

/// All from the same final positions and velocities.
template <class Real>
void Substep<Real>::apply_fluid_forces() {
    std::fill(velocity_change_.begin(), velocity_change_.end(), Vec3<Real>{});
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
