// Boundaries of the water of scheme `conserving`: walls and the ends of periodic axes.
#pragma once

#include "plane.h"

namespace natator::physics {

/// A wall or an end of a periodic axis. Each particle in front of it, nearer than the kernel's support, has a ghost
/// behind it: a wall mirrors the particle, an end moves it along the normal by the length of the tank, to where it lies
/// before the other end.
template <class R>
struct Boundary {
    PlaneSurface<R> surface;
    R shift;  ///< of ghosts along the normal, length; 0 for a wall
};

/// Maximum number of boundaries that a ghost is behind: as many as meet in a corner.
inline constexpr int max_boundaries_of_ghost = 3;

/// A periodic axis: where the tank begins on it, and how long the tank is. Both are multiples of `grain`, a power
/// of two, and so are the places that to_tank() gives. All sums and differences of these near the tank are then exact:
/// two particles on either side of an end see each other at exactly opposite distances, as any other two do.
template <class R>
struct PeriodicAxis {
    int axis;  ///< 0 = x, 1 = y, 2 = z
    R low, length, grain;
};

inline namespace NATATOR_SET {

template <class R>
NATATOR_HD bool in_tank(const PeriodicAxis<R>& periodic, R x) {
    return x >= periodic.low && x < periodic.low + periodic.length;
}

/// The place in [low, low + length), to the grain, that is whole lengths away from x.
template <class R>
NATATOR_HD R to_tank(const PeriodicAxis<R>& periodic, R x) {
    if (!in_tank(periodic, x)) x -= periodic.length * std::floor((x - periodic.low) / periodic.length);
    x = periodic.grain * std::rint(x / periodic.grain);
    if (x < periodic.low) x += periodic.length;
    return x < periodic.low + periodic.length ? x : x - periodic.length;
}

template <class R>
NATATOR_HD R along(const Vec3<R>& v, int axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
/// v with another value along an axis.
template <class R>
NATATOR_HD Vec3<R> with(const Vec3<R>& v, int axis, R value) {
    return {axis == 0 ? value : v.x, axis == 1 ? value : v.y, axis == 2 ? value : v.z};
}

template <class R>
NATATOR_HD Vec3<R> to_tank(const PeriodicAxis<R>& periodic, const Vec3<R>& x) {
    return with(x, periodic.axis, to_tank(periodic, along(x, periodic.axis)));
}

/// Water itself is put back only where it has left.
template <class R>
NATATOR_HD Vec3<R> wrapped(const PeriodicAxis<R>& periodic, const Vec3<R>& x) {
    return in_tank(periodic, along(x, periodic.axis)) ? x : to_tank(periodic, x);
}

}  // namespace NATATOR_SET
}  // namespace natator::physics
