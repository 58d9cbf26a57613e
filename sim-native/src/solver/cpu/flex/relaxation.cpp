#include "flex_stages.h"

namespace natator::cpu {

/// Local relaxation: x_i += min(1, (1 + omega) / n_i) * sum of corrections, n_i = constraints of particle i (contacts
/// with depth > 0, fluid neighbours with r < R, springs, clusters). Global relaxation: x_i += omega * sum.
template <class Real>
void FlexStages<Real>::relax_and_apply() {
    const bool local = model_.parameters.relaxationMode == RelaxationMode::local;
    const Real omega = constants_.relaxation_factor;
    const auto apply = [&](int begin, int end) {
        for (int slot = begin; slot < end; ++slot) {
            const Real n = std::max(ws_.constraint_count[slot], Real(1));
            const Real scale = local ? std::min(Real(1), (1 + omega) / n) : omega;
            ws_.position.x[slot] += scale * ws_.correction.x[slot];
            ws_.position.y[slot] += scale * ws_.correction.y[slot];
            ws_.position.z[slot] += scale * ws_.correction.z[slot];
        }
    };
    apply(0, ws_.fluid);
    apply(ws_.solid_begin, ws_.slots);
}

/// The density constraint sets the corrections of the fluid; those of the solids start from 0.
template <class Real>
void FlexStages<Real>::clear_corrections() {
    for (auto* array : {&ws_.correction.x, &ws_.correction.y, &ws_.correction.z, &ws_.constraint_count})
        std::fill(array->begin() + ws_.solid_begin, array->begin() + ws_.slots, Real(0));
}

template void FlexStages<float>::clear_corrections();
template void FlexStages<double>::clear_corrections();
template void FlexStages<float>::relax_and_apply();
template void FlexStages<double>::relax_and_apply();

}  // namespace natator::cpu
