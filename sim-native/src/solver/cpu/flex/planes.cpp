#include "flex_stages.h"

namespace natator::cpu {

/// Where the distance d to a plane is below collisionDistance: move out by e = collisionDistance - d, then take
/// min(dynamicFriction * e, m) off the tangential displacement m since the substep's start (all of it if
/// m < staticFriction * e). Not pooled with other constraints.
template <class Real>
void FlexStages<Real>::solve_planes() {
    const MotionView<Real> slots = this->motion_view();
    PlaneView<Real> view{};
    int viewed = -1;
    for (const auto& [plane, block, chosen] : ws_.plane_groups) {
        if (plane != viewed) view = this->plane_view(plane);
        viewed = plane;
        motion_kernels_->push_from_plane(slots, block, chosen, view);
    }
}

template void FlexStages<float>::solve_planes();
template void FlexStages<double>::solve_planes();

}  // namespace natator::cpu
