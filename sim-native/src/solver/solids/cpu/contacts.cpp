#include "conserving_stages.h"

namespace natator::cpu {

/// Starts that overlap, what a scene, a request or a hand put too close, are pushed apart at a limited acceleration
/// (see overlap_acceleration) instead of within one substep, which would fling it away.
template <class Real>
Real ConservingStages<Real>::contact_depth(int i, int j) const {
    return physics::limited_depth(
        constants_.solid_rest_distance, norm(position_of_slot(i) - position_of_slot(j)), overlap_push_,
        [&] { return norm(start_of_slot(i) - start_of_slot(j)); }, [&] { return norm(base_.at(i) - base_.at(j)); });
}

/// Pair of solids, depth e = solid_rest_distance - r > 0, less where it started too deep, n = contacts with
/// e > 0 of a particle: Dx_i = w_i / (w_i n_i + w_j n_j) (e n - friction).
template <class Real>
void ConservingStages<Real>::solve_contacts() {
    contact_depth_.resize(ws_.contact.size());
    for (std::size_t k = 0; k < ws_.contact_slots.size(); ++k) {
        const int i = ws_.contact_slots[k];
        int active = 0;
        for (int c = ws_.contact_begin[k]; c < ws_.contact_begin[k + 1]; ++c) {
            contact_depth_[c] = contact_depth(i, ws_.contact[c]);
            active += contact_depth_[c] > 0;
        }
        ws_.constraint_count[i] = static_cast<Real>(active);
    }
    for (std::size_t k = 0; k < ws_.contact_slots.size(); ++k) {
        const int i = ws_.contact_slots[k];
        const Real wi = ws_.inverse_mass[i], contacts = ws_.constraint_count[i];
        if (contacts == 0 || wi == 0) continue;
        for (int c = ws_.contact_begin[k]; c < ws_.contact_begin[k + 1]; ++c) {
            const int j = ws_.contact[c];
            const Real depth = contact_depth_[c];
            if (!(depth > 0)) continue;
            const Real share = physics::split_share(wi, contacts, this->partner_weight(i, j), ws_.constraint_count[j]);
            ws_.correction.add(i, share * this->contact_push(i, j, depth));
        }
    }
    for (const int slot : ws_.contact_slots) this->apply_correction(slot);
}

template void ConservingStages<float>::solve_contacts();
template void ConservingStages<double>::solve_contacts();

}  // namespace natator::cpu
