// Contacts of particles, and Coulomb friction at particles and planes.
#pragma once

#include "constants.h"
#include "vec3.h"

namespace natator::physics {

template <class R>
struct Friction {
    bool on;
    R sticking;  ///< static_friction
    R sliding;   ///< particle_friction or dynamic_friction
};

inline namespace NATATOR_SET {

/// Friction: the part of the displacement `moved` that a contact of this depth e takes off: the tangential part as a
/// whole if its length m is below static_friction * e, else min(sliding * e, m) of it. Macklin, Müller, Chentanez, Kim:
/// Unified Particle Physics for Real-Time Applications (2014), eq. 24, with the limits that NVIDIA Flex was measured to
/// have.
template <class T, class N, class R>
NATATOR_HD Vec3<T> friction(const Vec3<T>& moved, const Vec3<N>& normal, T depth, const Friction<R>& rule) {
    const Vec3<T> tangential = moved - dot(moved, normal) * normal;
    const T m = norm(tangential);
    const T slid = minimum(rule.sliding * depth, m);
    const T held = m < rule.sticking * depth ? m : slid;
    return held / (m > 0 ? m : one<T>()) * tangential;
}

/// e n - friction, for two particles at distance r of each other; moved() is the relative displacement since the
/// substep's start. Each takes its share of it.
template <class T, class Moved>
NATATOR_HD Vec3<T> contact_push(const Vec3<T>& difference, T r, T depth, const Friction<T>& rule, const Moved& moved) {
    const Vec3<T> normal = r > 0 ? difference / r : Vec3<T>{};
    const Vec3<T> push = depth * normal;
    return rule.on ? push - friction(moved(), normal, depth, rule) : push;
}

/// Scheme `flex`: w_i / (w_i + w_j).
template <class T>
NATATOR_HD T weight_share(T own, T other) {
    const T weights = own + other;
    return weights > 0 ? own / weights : T(0);
}

/// Scheme `conserving`: w_i / (w_i n_i + w_j n_j), n = contacts that are not apart of a particle. Tonge, Benevolenski,
/// Voroshilov: Mass Splitting for Jitter-Free Parallel Rigid Body Simulation (2012). w_i must not be 0, nor n_i.
template <class T>
NATATOR_HD T split_share(T own, T contacts, T other, T contacts_of_other) {
    return own / (own * contacts + other * contacts_of_other);
}

/// Shock propagation, how it changes the weight of a contact's partner: masses fall with the height against gravity,
/// m exp(-rate height), from wherever heights are counted, so only the ratio exp(-rate (height_i - height_j)) enters
/// (Guendelman, Bridson, Fedkiw: Nonconvex Rigid Bodies with Stacking, 2003, sec. 7.2 have infinite mass below
/// instead).
template <class T>
NATATOR_HD T shock_factor(const Vec3<T>& up, T rate, const Vec3<T>& from_partner) {
    const T exponent = -rate * dot(up, from_partner), limit = T(max_shock_exponent);
    return exponential(exponent < -limit ? -limit : minimum(exponent, limit));
}

/// Scheme `conserving`: depth of a contact beyond what this substep may leave of it. One that was deep at the start
/// gets shallower by at most `push` = a h^2, a = overlap acceleration, or by what its motion does. The distances at the
/// start and at the predicted positions are asked for only where they matter.
template <class T, class AtStart, class Predicted>
NATATOR_HD T limited_depth(T rest, T r, T push, const AtStart& r_at_start, const Predicted& r_predicted) {
    const T depth = rest - r;
    if (!(depth > push)) return depth;
    const T at_start = rest - r_at_start();
    if (!(at_start > push)) return depth;
    return depth - positive_part(minimum(at_start, rest - r_predicted()) - push);
}

}  // namespace NATATOR_SET
}  // namespace natator::physics
