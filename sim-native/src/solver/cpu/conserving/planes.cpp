#include "conserving_stages.h"

namespace natator::cpu {

/// Where the distance d to a plane is below collisionDistance: move out by e = collisionDistance - d, then take
/// min(dynamicFriction * e, m) off the tangential displacement m since the substep's start (all of it if
/// m < staticFriction * e).
template <class Real>
void ConservingStages<Real>::solve_planes() {
    for (const auto& [slot, plane] : ws_.plane_contacts) {
        const Vector3<Real> normal = model_.planes[plane].normal.template cast<Real>();
        const Real offset = static_cast<Real>(model_.planes[plane].offset);
        const Real depth = constants_.collision_distance - (normal.dot(position_of_slot(slot)) + offset);
        if (!(depth > 0)) continue;
        move(slot, depth * normal);
        if (!plan_.plane_friction) continue;
        const Vector3<Real> moved = position_of_slot(slot) - start_of_slot(slot);
        move(slot, -this->friction(moved, normal, depth, constants_.dynamic_friction));
    }
}

template void ConservingStages<float>::solve_planes();
template void ConservingStages<double>::solve_planes();

}  // namespace natator::cpu
