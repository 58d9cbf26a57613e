#include <bit>

#include "../substep.h"
#include "physics/effects.h"
#include "physics/plane.h"

namespace natator::cpu {

/// Acts along the normal only.
template <class Real>
void Substep<Real>::apply_adhesion() {
    const Real limit = static_cast<Real>(model_.parameters.adhesion) * h_ * h_;
    const Real touching = constants_.collision_distance + Real(physics::touching_tolerance) * constants_.radius;
    for (int plane = static_cast<int>(model_.planes.size()) - 1; plane >= 0; --plane) {
        const Vec3<Real> normal = vec3<Real>(model_.planes[plane].normal.template cast<Real>());
        const Real offset = static_cast<Real>(model_.planes[plane].offset);
        for (int i = 0; i < ws_.particles; ++i) {
            if (inverse_mass_[i] == 0 || dot(normal, vec3(state_->position[i])) + offset > touching) continue;
            const int slot = ws_.slot_of[i];
            const Vec3<Real> x = position_of_slot(slot);
            const Real left = dot(normal, x) + offset - constants_.collision_distance;
            if (!(left > 0)) continue;
            const Real back = physics::taken_back(left, limit);
            ws_.position.set(slot, x - back * normal);
            new_velocity_[i] -= back / h_ * normal;
        }
    }
}

/// For particles that end at a plane, from the impact speed 2 |g| h on.
template <class Real>
void Substep<Real>::apply_restitution() {
    const Real restitution = static_cast<Real>(model_.parameters.restitution);
    const Real slowest = 2 * h_ * static_cast<Real>(model_.parameters.gravity.norm());
    const Real touching = constants_.collision_distance + Real(physics::touching_tolerance) * constants_.radius;
    for_each_plane_group(ws_.all_blocks(), [&](int block, unsigned chosen, const PlaneView<Real>& plane) {
        const Vec3<Real> normal{plane.normal[0], plane.normal[1], plane.normal[2]};
        for (unsigned rest = chosen; rest != 0; rest &= rest - 1) {
            const int slot = block * lanes + std::countr_zero(rest);
            if (dot(normal, position_of_slot(slot)) + plane.offset > touching) continue;
            const int i = ws_.particle_of[slot];
            const Real missing =
                physics::rebound_speed(normal, vec3(ws_.unsorted_velocity[i]), new_velocity_[i], restitution, slowest);
            if (missing > 0) new_velocity_[i] += missing * normal;
        }
    });
}

template void Substep<float>::apply_adhesion();
template void Substep<double>::apply_adhesion();
template void Substep<float>::apply_restitution();
template void Substep<double>::apply_restitution();

}  // namespace natator::cpu
