#include "conserving_stages.h"

namespace natator::cpu {

/// Finds the planes that solids may touch.
template <class Real>
void ConservingStages<Real>::find_plane_contacts() {
    Substep<Real>::find_plane_contacts();
    const int first_solid = ws_.solid_begin / lanes;
    std::erase_if(ws_.plane_groups, [&](const auto& group) { return group.block < first_solid; });
}

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

template void ConservingStages<float>::find_plane_contacts();
template void ConservingStages<double>::find_plane_contacts();
template void ConservingStages<float>::solve_planes();
template void ConservingStages<double>::solve_planes();

}  // namespace natator::cpu
