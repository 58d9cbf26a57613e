#include "flex_stages.h"

namespace natator::cpu {

/// Distance constraint: Dx_i = k w_i / (w_i + w_j) (l0 - l) n. The stiffness is used as it is in every iteration.
template <class Real>
void FlexStages<Real>::solve_springs() {
    for (std::size_t s = 0; s < model_.springs.size(); ++s) {
        const int a = ws_.slot_of[model_.springs[s].a];
        const int b = ws_.slot_of[model_.springs[s].b];
        const Real wa = ws_.inverse_mass[a], wb = ws_.inverse_mass[b];
        const Vector3<Real> difference = position_of_slot(a) - position_of_slot(b);
        const Real length = difference.norm();
        const bool movable = wa + wb > 0 && length > 0;
        const Real stretch = state_->spring_rest_length[s] - length;
        const Vector3<Real> push = movable
                                       ? Vector3<Real>(spring_stiffness_[s] * stretch / (wa + wb) / length * difference)
                                       : Vector3<Real>::Zero();
        add_correction(a, wa * push);
        add_correction(b, -wb * push);
    }
}

template void FlexStages<float>::solve_springs();
template void FlexStages<double>::solve_springs();

}  // namespace natator::cpu
