#include "flex_stages.h"

namespace natator::cpu {

/// Where the distance d to a plane is below collisionDistance: move out by e = collisionDistance - d, then take
/// min(dynamicFriction * e, m) off the tangential displacement m since the substep's start (all of it if
/// m < staticFriction * e). Not pooled with other constraints.
template <class Real>
void FlexStages<Real>::solve_planes() {
    for (const auto& [slot, plane] : ws_.plane_contacts) {
        const Vector3<Real> normal = model_.planes[plane].normal.template cast<Real>();
        const Real offset = static_cast<Real>(model_.planes[plane].offset);
        Vector3<Real> x = position_of_slot(slot);
        const Real depth = constants_.collision_distance - (normal.dot(x) + offset);
        if (!(depth > 0)) continue;
        x += depth * normal;
        if (plan_.plane_friction)
            x -= this->friction(x - start_of_slot(slot), normal, depth, constants_.dynamic_friction);
        ws_.position.set(slot, x);
    }
}

template void FlexStages<float>::solve_planes();
template void FlexStages<double>::solve_planes();

}  // namespace natator::cpu
