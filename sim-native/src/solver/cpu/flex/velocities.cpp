#include <cmath>

#include "flex_stages.h"

namespace natator::cpu {

/// u = (x - x_start) / h; Du_i = h (viscosity * sum over fluid j of W_ij (u_j - u_i) - damping * u_i), W from the final
/// positions; v = v* + clamp(u + Du - v*, maxAcceleration * h), |v| <= maxSpeed. Positions are not clamped.
template <class Real>
void FlexStages<Real>::update_velocities() {
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
            ws_.velocity.set(slot, moved_per_second(slot));
        }
        kernels_->smooth_velocities(fluid_view());
    }
    for (int i = 0; i < ws_.particles; ++i) {
        const int slot = ws_.slot_of[i];
        const Vector3<Real> u = moved_per_second(slot);
        Vector3<Real> v = u;
        if (plan_.viscosity && slot < ws_.fluid) v += viscosity_step * ws_.correction.at(slot);
        if (plan_.damping) v -= damping_step * u;
        if (plan_.clamp_acceleration) {
            const Vector3<Real> predicted = ws_.predicted.at(slot);
            v = predicted + clamped(Vector3<Real>(v - predicted), most_change);
        }
        if (plan_.clamp_speed) v = clamped(v, constants_.max_speed);
        this->new_velocity_[i] = v;
    }
}

template void FlexStages<float>::update_velocities();
template void FlexStages<double>::update_velocities();

}  // namespace natator::cpu
