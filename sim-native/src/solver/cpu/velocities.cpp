#include <cmath>

#include "stages.h"

namespace natator::cpu {

/// u = (x - x_start) / h; Du_i = h (viscosity * sum over fluid j of W_ij (u_j - u_i) - damping * u_i), W from the final
/// positions; v = v* + clamp(u + Du - v*, maxAcceleration * h), |v| <= maxSpeed. Positions are not clamped.
template <class Real>
void Stages<Real>::update_velocities() {
    const SolverParameters& p = model_.parameters;
    const Real inverse_h = 1 / h_;
    const Real viscosity_step = h_ * static_cast<Real>(p.viscosity);
    const Real damping_step = h_ * static_cast<Real>(p.damping);
    const Real most_change = static_cast<Real>(p.maxAcceleration) * h_;
    const auto moved_per_second = [&](int slot) -> Vector3<Real> {
        return (position_of_slot(slot) - start_of_slot(slot)) * inverse_h;
    };

    if (plan_.viscosity) {
        for (int slot = 0; slot < ws_.fluid; ++slot) {
            const Vector3<Real> u = moved_per_second(slot);
            ws_.velocity.x[slot] = u.x();
            ws_.velocity.y[slot] = u.y();
            ws_.velocity.z[slot] = u.z();
        }
        kernels_->smooth_velocities(fluid_view());
    }
    for (int i = 0; i < ws_.particles; ++i) {
        const int slot = ws_.slot_of[i];
        const Vector3<Real> u = moved_per_second(slot);
        Vector3<Real> v = u;
        if (plan_.viscosity && slot < ws_.fluid)
            v += viscosity_step * Vector3<Real>(ws_.correction.x[slot], ws_.correction.y[slot], ws_.correction.z[slot]);
        if (plan_.damping) v -= damping_step * u;
        if (plan_.clamp_acceleration) {
            const Vector3<Real> predicted(ws_.predicted.x[slot], ws_.predicted.y[slot], ws_.predicted.z[slot]);
            v = predicted + clamped(Vector3<Real>(v - predicted), most_change);
        }
        if (plan_.clamp_speed) v = clamped(v, constants_.max_speed);
        ws_.predicted_velocity[i] = v;
    }
}

/// The new velocities depend on every other value of the substep, and a sum of differences of a value with itself is
/// not 0 as soon as one is not finite.
template <class Real>
bool Stages<Real>::finite() const {
    Real difference = 0;
    for (int i = 0; i < ws_.particles; ++i) {
        const Vector3<Real> x = position_of_slot(ws_.slot_of[i]);
        difference += (ws_.predicted_velocity[i] - ws_.predicted_velocity[i]).sum() + (x - x).sum();
    }
    return difference == 0;
}

template <class Real>
std::optional<int> Stages<Real>::first_not_finite() const {
    for (int i = 0; i < ws_.particles; ++i) {
        const int slot = ws_.slot_of[i];
        const Vector3<Real> correction(ws_.correction.x[slot], ws_.correction.y[slot], ws_.correction.z[slot]);
        if (!ws_.predicted_velocity[i].allFinite() || !ws_.predicted_position[i].allFinite() ||
            !position_of_slot(slot).allFinite() || !correction.allFinite())
            return i;
    }
    return std::nullopt;
}

template <class Real>
void Stages<Real>::commit() {
    for (int i = 0; i < ws_.particles; ++i) {
        if (inverse_mass_[i] == 0) continue;
        state_->position[i] = position_of_slot(ws_.slot_of[i]);
        state_->velocity[i] = ws_.predicted_velocity[i];
    }
    state_->cluster_rotation = cluster_rotation_;
    state_->cluster_centre = cluster_centre_;
}

template void Stages<float>::update_velocities();
template void Stages<double>::update_velocities();
template bool Stages<float>::finite() const;
template bool Stages<double>::finite() const;
template std::optional<int> Stages<float>::first_not_finite() const;
template std::optional<int> Stages<double>::first_not_finite() const;
template void Stages<float>::commit();
template void Stages<double>::commit();

}  // namespace natator::cpu
