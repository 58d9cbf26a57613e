#include "flex_stages.h"

namespace natator::cpu {

/// Divides corrections by the number of constraints of each particle: contacts with depth > 0, fluid neighbours with r
/// < R, springs, clusters.
template <class Real>
void FlexStages<Real>::relax_and_apply() {
    const bool local = model_.parameters.flex.relaxationMode == RelaxationMode::local;
    this->on_all_threads(this->motion_view(), [&](const MotionView<Real>& slots) {
        motion_kernels_->relax(slots, constants_.relaxation_factor, local);
    });
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
