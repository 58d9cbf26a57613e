#include "flex_stages.h"

namespace natator::cpu {

template <class Real>
void FlexStages<Real>::solve_springs() {
    for (std::size_t s = 0; s < model_.springs.size(); ++s) {
        const int a = ws_.slot_of[model_.springs[s].a];
        const int b = ws_.slot_of[model_.springs[s].b];
        const Real wa = ws_.inverse_mass[a], wb = ws_.inverse_mass[b];
        const Vec3<Real> push = physics::spring_push(position_of_slot(a) - position_of_slot(b), wa + wb,
                                                     state_->spring_rest_length[s], this->spring_rules_[s]);
        add_correction(a, wa * push);
        add_correction(b, -wb * push);
    }
}

template void FlexStages<float>::solve_springs();
template void FlexStages<double>::solve_springs();

}  // namespace natator::cpu
