#include <atomic>

#include "substep.h"

namespace natator::cpu {

/// The new velocities depend on every other value of the substep. The difference of a value with itself is not 0 if the
/// value is not finite.
template <class Real>
bool Substep<Real>::finite() const {
    std::atomic<bool> all_finite = true;
    const auto check = [&](const Real* values, std::size_t count) {
        team_->for_parts(static_cast<int>(count), min_part * lanes, [&](int, int begin, int end) {
            if (!motion_kernels_->finite(values + begin, end - begin)) all_finite = false;
        });
    };
    const auto& [x, y, z] = ws_.position;
    check(&new_velocity_[0].x, 3 * new_velocity_.size());
    for (const auto* coordinate : {&x, &y, &z}) check(coordinate->data(), coordinate->size());
    return all_finite;
}

template <class Real>
void Substep<Real>::forget() {
    std::fill(new_velocity_.begin(), new_velocity_.end(), Vec3<Real>{});
    std::fill(ws_.unsorted_position.begin(), ws_.unsorted_position.end(), Vector3<Real>::Zero());
    for (const int slot : ws_.slot_of) {
        ws_.position.set(slot, {});
        ws_.correction.set(slot, {});
    }
}

template <class Real>
std::optional<int> Substep<Real>::first_not_finite() const {
    for (int i = 0; i < ws_.particles; ++i) {
        const int slot = ws_.slot_of[i];
        for (const Vec3<Real>& v :
             {new_velocity_[i], vec3(ws_.unsorted_position[i]), position_of_slot(slot), ws_.correction.at(slot)})
            if (!eigen(v).allFinite()) return i;
    }
    return std::nullopt;
}

template <class Real>
void Substep<Real>::commit() {
    team_->for_each(ws_.particles, min_part * lanes, [this](int i) {
        if (inverse_mass_[i] == 0) return;
        state_->position[i] = eigen(position_of_slot(ws_.slot_of[i]));
        state_->velocity[i] = eigen(new_velocity_[i]);
    });
    state_->cluster_rotation = cluster_rotation_;
    for (std::size_t k = 0; k < cluster_centre_.size(); ++k) state_->cluster_centre[k] = eigen(cluster_centre_[k]);
}

template void Substep<float>::forget();
template void Substep<double>::forget();
template bool Substep<float>::finite() const;
template bool Substep<double>::finite() const;
template std::optional<int> Substep<float>::first_not_finite() const;
template std::optional<int> Substep<double>::first_not_finite() const;
template void Substep<float>::commit();
template void Substep<double>::commit();

}  // namespace natator::cpu
