#include "flex_stages.h"

namespace natator::cpu {

/// Pair that is not fluid-fluid, depth e = solid_rest_distance - r > 0: Dx_i = w_i / (w_i + w_j) (e n - friction).
template <class Real>
void FlexStages<Real>::solve_contacts() {
    for (std::size_t k = 0; k < ws_.contact_slots.size(); ++k) {
        const int i = ws_.contact_slots[k];
        for (int c = ws_.contact_begin[k]; c < ws_.contact_begin[k + 1]; ++c) {
            const int j = ws_.contact[c];
            const Real depth = constants_.solid_rest_distance - norm(position_of_slot(i) - position_of_slot(j));
            if (!(depth > 0)) continue;
            const Real share = physics::weight_share(ws_.inverse_mass[i], this->partner_weight(i, j));
            add_correction(i, share * this->contact_push(i, j, depth));
        }
    }
}

template void FlexStages<float>::solve_contacts();
template void FlexStages<double>::solve_contacts();

}  // namespace natator::cpu
