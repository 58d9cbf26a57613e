#include <algorithm>
#include <bit>

#include "../substep.h"
#include "touching.h"

namespace natator::cpu {
/// Of the distance by which a particle that touched a plane at the substep's start has left it, up to adhesion h^2 is
/// taken back, so a steady pull is withstood if its acceleration is at most `adhesion`. Acts along the normal only.
template <class Real>
void Substep<Real>::adhere() {
    const Real most = static_cast<Real>(model_.parameters.adhesion) * h_ * h_;
    const Real touching = constants_.collision_distance + Real(touching_tolerance) * constants_.radius;
    for (int plane = static_cast<int>(model_.planes.size()) - 1; plane >= 0; --plane) {
        const Vector3<Real> normal = model_.planes[plane].normal.template cast<Real>();
        const Real offset = static_cast<Real>(model_.planes[plane].offset);
        for (int i = 0; i < ws_.particles; ++i) {
            if (inverse_mass_[i] == 0 || normal.dot(state_->position[i]) + offset > touching) continue;
            const int slot = ws_.slot_of[i];
            const Vector3<Real> x = position_of_slot(slot);
            const Real left = normal.dot(x) + offset - constants_.collision_distance;
            if (!(left > 0)) continue;
            const Real back = std::min(left, most);
            ws_.position.set(slot, x - back * normal);
            new_velocity_[i] -= back / h_ * normal;
        }
    }
}

/// Where a particle ends at a plane after it came in at normal velocity v*_n, it leaves at -restitution v*_n, as in
/// Müller, Macklin, Chentanez, Jeschke, Kim: Detailed Rigid Body Simulation with Extended Position Based Dynamics
/// (2020), eq. 34. Not below the impact speed 2 |g| h, so that what lies on a plane does not start to jump.
template <class Real>
void Substep<Real>::rebound() {
    const Real restitution = static_cast<Real>(model_.parameters.restitution);
    const Real slowest = 2 * h_ * static_cast<Real>(model_.parameters.gravity.norm());
    const Real touching = constants_.collision_distance + Real(touching_tolerance) * constants_.radius;
    for_each_plane_group(ws_.all_blocks(), [&](int block, unsigned chosen, const PlaneView<Real>& plane) {
        const Vector3<Real> normal(plane.normal[0], plane.normal[1], plane.normal[2]);
        for (unsigned rest = chosen; rest != 0; rest &= rest - 1) {
            const int slot = block * lanes + std::countr_zero(rest);
            if (normal.dot(position_of_slot(slot)) + plane.offset > touching) continue;
            const int i = ws_.particle_of[slot];
            const Real impact = -normal.dot(ws_.predicted_velocity[i]);
            if (!(impact > slowest)) continue;
            const Real missing = restitution * impact - normal.dot(new_velocity_[i]);
            if (missing > 0) new_velocity_[i] += missing * normal;
        }
    });
}

template void Substep<float>::adhere();
template void Substep<double>::adhere();
template void Substep<float>::rebound();
template void Substep<double>::rebound();

}  // namespace natator::cpu
