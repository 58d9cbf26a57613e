#include "physics/velocity.h"
#include "substep.h"

namespace natator::cpu {

/// v* (physics::predicted_velocity; g times buoyancy for fluid) and x* = x + h v*. A particle of infinite mass moves
/// within the substep and is put back at its end.
template <class Real>
void Substep<Real>::predict() {
    const Vec3<Real> gravity = vec3<Real>(model_.parameters.gravity.template cast<Real>());
    const Vec3<Real> fluid_gravity = Real(model_.parameters.buoyancy) * gravity;
    team_->for_parts(ws_.particles, min_part * lanes, [&](int, int begin, int end) {
        for (int i = begin; i < end; ++i) {
            const Vec3<Real>& g = model_.is_fluid(i) ? fluid_gravity : gravity;
            const Vec3<Real> v = predicted_velocity(vec3(state_->velocity[i]), inverse_mass_[i], g, h_,
                                                    plan_.clamp_speed, constants_.max_speed);
            ws_.unsorted_velocity[i] = eigen(v);
            ws_.unsorted_position[i] = eigen(vec3(state_->position[i]) + h_ * v);
        }
    });
}

template void Substep<float>::predict();
template void Substep<double>::predict();

}  // namespace natator::cpu
