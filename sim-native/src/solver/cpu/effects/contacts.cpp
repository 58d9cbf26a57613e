#include "physics/effects.h"

#include "../substep.h"

namespace natator::cpu {

template <class Real>
void Substep<Real>::damp_contacts() {
    const Real step = h_ * static_cast<Real>(model_.parameters.dissipation);
    const auto touch = [this](int i, int j) {
        return norm(vec3(ws_.unsorted_position[i]) - vec3(ws_.unsorted_position[j])) < constants_.solid_rest_distance;
    };
    for (std::size_t k = 0; k < ws_.contact_slots.size(); ++k) {
        const int i = ws_.particle_of[ws_.contact_slots[k]];
        int& count = overlaps_[ws_.contact_slots[k]];
        count = 0;
        for (int c = ws_.contact_begin[k]; c < ws_.contact_begin[k + 1]; ++c)
            count += touch(i, ws_.particle_of[ws_.contact[c]]);
        velocity_change_[i] = {};
    }
    for (std::size_t k = 0; k < ws_.contact_slots.size(); ++k) {
        const int slot = ws_.contact_slots[k];
        const int i = ws_.particle_of[slot];
        const Real n = static_cast<Real>(overlaps_[slot]);
        if (model_.scheme == Scheme::flex) {
            velocity_change_[i] = -physics::dissipated(n, step) * new_velocity_[i];
            continue;
        }
        if (inverse_mass_[i] == 0) continue;
        for (int c = ws_.contact_begin[k]; c < ws_.contact_begin[k + 1]; ++c) {
            const int j = ws_.particle_of[ws_.contact[c]];
            if (!touch(i, j)) continue;
            const Real both = n + static_cast<Real>(overlaps_[ws_.contact[c]]);
            const Real share = physics::impulse_share(inverse_mass_[i], inverse_mass_[j]);
            velocity_change_[i] +=
                share * physics::dissipated_by_pair(both, step) * (new_velocity_[j] - new_velocity_[i]);
        }
    }
    for (const int slot : ws_.contact_slots) {
        const int i = ws_.particle_of[slot];
        new_velocity_[i] += velocity_change_[i];
    }
}

template void Substep<float>::damp_contacts();
template void Substep<double>::damp_contacts();

}  // namespace natator::cpu
