// Planes n x + offset = 0 that particles keep a distance from.
#pragma once

#include "contact.h"

namespace natator::physics {

template <class R>
struct PlaneSurface {
    Vec3<R> normal;
    R offset;
};

inline namespace NATATOR_SET {

template <class T, class R>
NATATOR_HD T distance_to(const PlaneSurface<R>& plane, const Vec3<T>& x) {
    return dot(x, plane.normal) + plane.offset;
}

/// Where a particle `depth` e > 0 too close goes: out by e along the normal, then friction takes its part of the
/// displacement moved(to) since the substep's start. `from` and the result may be displacements.
template <class T, class R, class Moved>
NATATOR_HD Vec3<T> resolve_plane_penetration(const Vec3<T>& from, T depth, const Vec3<R>& normal,
                                             const Friction<R>& rule, const Moved& moved) {
    const Vec3<T> to = from + depth * normal;
    return rule.on ? to - friction(moved(to), normal, depth, rule) : to;
}

/// Speed along the normal that a plane gives back to a particle that came in at v* and leaves at v: restitution v*_n in
/// all, as in Müller, Macklin, Chentanez, Jeschke, Kim: Detailed Rigid Body Simulation with Extended Position Based
/// Dynamics (2020), eq. 34; 0 below the `slowest` impact, so that what lies on a plane does not start to jump.
template <class T>
NATATOR_HD T rebound_speed(const Vec3<T>& normal, const Vec3<T>& predicted, const Vec3<T>& v, T restitution,
                           T slowest) {
    const T impact = -dot(normal, predicted);
    return impact > slowest ? positive_part(restitution * impact - dot(normal, v)) : T(0);
}

/// Scheme `conserving`, before a substep: particles that start behind a plane are put on it before they move, which
/// gives them no velocity. Pre-stabilisation, Macklin, Müller, Chentanez, Kim (2014), 4.4.
template <class T>
NATATOR_HD Vec3<T> put_before(const PlaneSurface<T>& plane, T collision_distance, const Vec3<T>& x) {
    const T distance = dot(plane.normal, x) + (plane.offset - collision_distance);
    return distance < -T(overlap_tolerance) * collision_distance ? x - distance * plane.normal : x;
}

/// Scheme `conserving`: keeps water at least `distance` in front of a plane. What would come nearer is put there, and
/// its velocity into the plane ends, as in an impact without rebound (Moreau: Unilateral contact and dry friction,
/// 1988): a wall can take kinetic energy, never give it.
template <class T>
NATATOR_HD void hold_before(const PlaneSurface<T>& plane, T distance, Vec3<T>& x, Vec3<T>& velocity) {
    const T gap = dot(plane.normal, x) + (plane.offset - distance);
    if (gap >= 0) return;
    x -= gap * plane.normal;
    velocity += positive_part(-dot(plane.normal, velocity)) * plane.normal;
}

}  // namespace NATATOR_SET
}  // namespace natator::physics
