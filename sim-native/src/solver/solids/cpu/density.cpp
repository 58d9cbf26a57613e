#include "conserving_stages.h"

namespace natator::cpu {

/// Tells the water the velocities of the solids.
template <class Real>
void ConservingStages<Real>::send_velocities_to_water() {
    for (const int i : ws_.solid_ids) water_->set_velocity(i, present_velocity(i));
}

/// Moves the solids by what the water has done to them since send_velocities_to_water.
template <class Real>
void ConservingStages<Real>::move_solids_with_water() {
    for (const int i : ws_.solid_ids) {
        if (!(inverse_mass_[i] > 0)) continue;
        move(ws_.slot_of[i], h_ * (water_->velocity(i) - present_velocity(i)));
    }
}

template <class Real>
void ConservingStages<Real>::compute_density_impulses() {
    send_velocities_to_water();
    if (!ws_.solid_ids.empty()) water_->update_ghost_velocities(*this->team_);
    water_->compute_impulses(*this->team_);
    if (model_.parameters.conserving.density_tolerance > 0) density_error_ = water_->target_residual().mean;
}

template <class Real>
void ConservingStages<Real>::apply_density_impulses() {
    water_->apply_corrected_impulses(*this->team_);
    move_solids_with_water();
}

template <class Real>
void ConservingStages<Real>::return_zeroth_order_correction() {
    send_velocities_to_water();
    water_->return_zeroth_order_correction(*this->team_);
    move_solids_with_water();
}

/// The fluid goes where its velocities take it.
template <class Real>
void ConservingStages<Real>::move_water() {
    this->team_->for_each(static_cast<int>(ws_.fluid_ids.size()), this->min_part * lanes, [this](int k) {
        const int i = ws_.fluid_ids[k], slot = ws_.slot_of[i];
        if (!(inverse_mass_[i] > 0)) return;
        Vec3<Real> v = water_->velocity(i);
        if (plan_.clamp_speed) v = clamped(v, constants_.max_speed);
        const auto displaced = [&] { return h_ * (v - ws_.predicted_velocity.at(slot)); };
        Vec3<Real> x = base_.at(slot) + displaced();
        for (const physics::PlaneSurface<Real>& plane : planes_) hold_before(plane, wall_distance(i), x, v);
        displacement_.set(slot, displaced());  // what velocities are made of
        ws_.position.set(slot, x);
    });
}

template void ConservingStages<float>::send_velocities_to_water();
template void ConservingStages<double>::send_velocities_to_water();
template void ConservingStages<float>::move_solids_with_water();
template void ConservingStages<double>::move_solids_with_water();
template void ConservingStages<float>::compute_density_impulses();
template void ConservingStages<double>::compute_density_impulses();
template void ConservingStages<float>::apply_density_impulses();
template void ConservingStages<double>::apply_density_impulses();
template void ConservingStages<float>::return_zeroth_order_correction();
template void ConservingStages<double>::return_zeroth_order_correction();
template void ConservingStages<float>::move_water();
template void ConservingStages<double>::move_water();

}  // namespace natator::cpu
