#include "conserving_stages.h"
#include "physics/body_momentum.h"

namespace natator::cpu {

template <class Real>
void ConservingStages<Real>::keep_body_momentum() {
    const auto place = [this](int i) { return cast<double>(position_of_slot(ws_.slot_of[i])); };
    const auto start = [this](int i) { return cast<double>(vec3(state_->position[i])); };
    for (const std::vector<int>& body : bodies_) {
        physics::BodyCentres centres;
        for (const int i : body) add(centres, 1 / static_cast<double>(inverse_mass_[i]), start(i), place(i));
        const Vec3<double> start_centre = centres.start / centres.mass, centre = centres.now / centres.mass;
        physics::BodyMoments moments;
        for (const int i : body) {
            const double mass = 1 / static_cast<double>(inverse_mass_[i]);
            const Vec3<double> impulse = mass / static_cast<double>(h_) * cast<double>(internal_[i]);
            add(moments, mass, impulse, start(i) - start_centre, place(i) - centre);
        }
        const physics::BodyMotion motion = motion_of(centres, moments);
        for (const int i : body) new_velocity_[i] += cast<Real>(velocity_at(motion, place(i)));
    }
}

/// u = v* + displacement / h, which rounds less than a difference of positions; internal forces give their momentum
/// back; damping v / (1 + h damping).
template <class Real>
void ConservingStages<Real>::update_velocities() {
    const Real kept = plan_.damping ? 1 / (1 + h_ * static_cast<Real>(model_.parameters.damping)) : Real(1);

    for_each_particle([this](int i) { new_velocity_[i] = present_velocity(i); });
    keep_body_momentum();
    for_each_particle([&](int i) {
        new_velocity_[i] = kept * new_velocity_[i];
        if (plan_.clamp_speed) new_velocity_[i] = clamped(new_velocity_[i], constants_.max_speed);
    });
}

template void ConservingStages<float>::keep_body_momentum();
template void ConservingStages<double>::keep_body_momentum();
template void ConservingStages<float>::update_velocities();
template void ConservingStages<double>::update_velocities();

}  // namespace natator::cpu
