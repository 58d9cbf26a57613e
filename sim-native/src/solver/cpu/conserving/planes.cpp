#include "conserving_stages.h"

namespace natator::cpu {

template <class Real>
void ConservingStages<Real>::solve_planes() {
    NearPlanes<Real> slots = this->near_planes();
    const auto lay = [](auto& to, auto& from) {
        to[0] = from.x.data();
        to[1] = from.y.data();
        to[2] = from.z.data();
    };
    lay(slots.base, base_);
    lay(slots.displacement, displacement_);
    this->resolve_plane_penetrations(slots);
}

template void ConservingStages<float>::solve_planes();
template void ConservingStages<double>::solve_planes();

}  // namespace natator::cpu
