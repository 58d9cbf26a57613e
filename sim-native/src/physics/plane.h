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
NATATOR_HD T rebound_speed(const Vec3<T>& normal, const Vec3<T>& drift, const Vec3<T>& v, T restitution, T slowest) {
    const T impact = -dot(normal, drift);
    return impact > slowest ? positive_part(restitution * impact - dot(normal, v)) : T(0);
}

/// Scheme `conserving`, before a substep: particles that start behind a plane are put on it before they move, which
/// gives them no velocity. Pre-stabilisation, Macklin, Müller, Chentanez, Kim (2014), 4.4.
template <class T>
NATATOR_HD Vec3<T> put_before(const PlaneSurface<T>& plane, T collision_distance, const Vec3<T>& x) {
    const T distance = dot(plane.normal, x) + (plane.offset - collision_distance);
    return distance < -T(overlap_tolerance) * collision_distance ? x - distance * plane.normal : x;
}

// What planes do to the fluid's density in scheme `conserving`. Behind a plane the density goes on as in fluid at rest,
// else particles crowd at walls and floor and the pressure there is wrong: the part of the kernel A (1 - q)^3 beyond
// distance s = q R of a particle, integrated,
//   n0 R^3 A 2 pi ((1 - q)^5 / 20 - (1 - q)^6 / 30), n0 = particles per volume of the rest packing,
// an idea of Koschier, Bender: Density Maps for Improved SPH Boundary Handling (2017), here in closed form.

/// t = 1 - q, between 0 and 1; `gap` lies between a plane and where the fluid behind it begins.
template <class T, class R>
NATATOR_HD T plane_nearness(T distance, R gap, R inverse_radius) {
    const T t = positive_part(1 - (distance + gap) * inverse_radius);
    return t < 1 ? t : one<T>();
}
/// `scale` = 2 pi n0 R^3 A.
template <class T, class R>
NATATOR_HD T plane_density(T t, R scale) {
    return scale * t * t * t * t * t * (R(1) / 20 - t / 30);
}
/// Minus its derivative by the distance.
template <class T, class R>
NATATOR_HD T plane_slope(T t, R scale, R inverse_radius) {
    return scale * inverse_radius * t * t * t * t * (R(1) / 4 - t / 5);
}

}  // namespace NATATOR_SET
}  // namespace natator::physics
