#include "conserving_stages.h"

namespace natator::cpu {

/// The solids move by what `push`, a stage of the water, does to them.
template <class Real>
template <class Push>
void ConservingStages<Real>::push_solids(const Push& push) {
    for (const int i : ws_.solid_ids) water_->set_velocity(i, present_velocity(i));
    push();
    for (const int i : ws_.solid_ids) {
        if (!(inverse_mass_[i] > 0)) continue;
        move(ws_.slot_of[i], h_ * (water_->velocity(i) - present_velocity(i)));
    }
}

template <class Real>
void ConservingStages<Real>::solve_density_constraint() {
    push_solids([this] {
        if (!ws_.solid_ids.empty()) water_->give_images_velocities(*this->team_);
        water_->push_apart(*this->team_);
    });
}

/// The fluid goes where its velocities take it.
template <class Real>
void ConservingStages<Real>::move_fluid() {
    push_solids([this] { water_->return_zeroth_order_correction(*this->team_); });
    water_->add_pressure_forces();
    water_->apply_wall_pressure(*this->team_);
    this->team_->for_each(static_cast<int>(ws_.fluid_ids.size()), this->shortest_part * lanes, [this](int k) {
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

template void ConservingStages<float>::solve_density_constraint();
template void ConservingStages<double>::solve_density_constraint();
template void ConservingStages<float>::move_fluid();
template void ConservingStages<double>::move_fluid();

}  // namespace natator::cpu
