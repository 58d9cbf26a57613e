#include "flex_stages.h"

namespace natator::cpu {

/// See physics::flex_velocity; W of the viscosity is taken from the final positions. Positions are not clamped.
template <class Real>
void FlexStages<Real>::update_velocities() {
    const SolverParameters& p = model_.parameters;
    const MotionView<Real> all = this->motion_view();
    this->on_all_threads(
        all, [this](const MotionView<Real>& slots) { motion_kernels_->displacement_velocity(slots, 1 / h_); });
    if (plan_.viscosity) {
        const FluidView<Real> fluid = fluid_view();
        this->on_all_threads(fluid, kernels_->pack);
        this->on_all_threads(fluid, kernels_->pack_velocity);
        this->on_all_threads(fluid, kernels_->smooth_velocities);
    }
    const physics::VelocityRule<Real> rule{.viscosity = plan_.viscosity,
                                           .viscosity_step = h_ * static_cast<Real>(p.flex.viscosity),
                                           .damping = plan_.damping,
                                           .damping_step = h_ * static_cast<Real>(p.damping),
                                           .clamp_acceleration = plan_.clamp_acceleration,
                                           .max_change = h_ * static_cast<Real>(p.max_acceleration),
                                           .clamp_speed = plan_.clamp_speed,
                                           .max_speed = constants_.max_speed};
    this->on_all_threads(
        all, [&](const MotionView<Real>& slots) { motion_kernels_->finish_velocity(slots, ws_.blocks(), rule); });
    this->team_->for_parts(ws_.particles, this->min_part * lanes, [this](int, int begin, int end) {
        for (int i = begin; i < end; ++i) this->new_velocity_[i] = ws_.velocity.at(ws_.slot_of[i]);
    });
}

template void FlexStages<float>::update_velocities();
template void FlexStages<double>::update_velocities();

}  // namespace natator::cpu
