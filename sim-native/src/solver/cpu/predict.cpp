#include "substep.h"

namespace natator::cpu {

/// v* = v + h g (g times buoyancy for fluid; no gravity on particles of infinite mass), |v*| <= maxSpeed,
/// x* = x + h v*. A particle of infinite mass moves within the substep and is put back at its end.
template <class Real>
void Substep<Real>::predict() {
    const Vector3<Real> gravity = model_.parameters.gravity.template cast<Real>();
    const Vector3<Real> fluid_gravity = gravity * Real(model_.parameters.buoyancy);
    team_->for_parts(ws_.particles, shortest_part * lanes, [&](int, int begin, int end) {
        for (int i = begin; i < end; ++i) {
            Vector3<Real> v = state_->velocity[i];
            if (inverse_mass_[i] > 0) v += h_ * (model_.is_fluid(i) ? fluid_gravity : gravity);
            if (plan_.clamp_speed) v = clamped(v, constants_.max_speed);
            ws_.predicted_velocity[i] = v;
            ws_.predicted_position[i] = state_->position[i] + h_ * v;
        }
    });
}

template void Substep<float>::predict();
template void Substep<double>::predict();

}  // namespace natator::cpu
