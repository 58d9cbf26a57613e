// Where the water of scheme `conserving` ends, and what it finds beyond: images of what is before the end.
#pragma once

#include "plane.h"

namespace natator::physics {

/// Everything nearer before it than the kernel's support has an image beyond it: a wall's is mirrored; at an end of a
/// periodic axis it is what it is of, a length of the tank further on, where the other end follows.
template <class R>
struct Border {
    PlaneSurface<R> surface;
    R shift;  ///< how far further on along the normal, length; 0 of a wall
};

/// An axis that closes up with itself: where the tank begins on it, and how long it is. Both are multiples of `grain`, a power
/// of two, and so are the places that to_tank() gives. All sums and differences of these near the tank are then exact: two
/// particles on either side of the seam see each other at exactly opposite distances, as any other two do.
template <class R>
struct Seam {
    int axis;  ///< 0 = x, 1 = y, 2 = z
    R low, length, grain;
};

inline namespace NATATOR_SET {

template <class R>
NATATOR_HD bool in_tank(const Seam<R>& seam, R x) {
    return x >= seam.low && x < seam.low + seam.length;
}

/// The place in [low, low + length), to the grain, that is whole lengths away from x.
template <class R>
NATATOR_HD R to_tank(const Seam<R>& seam, R x) {
    if (!in_tank(seam, x)) x -= seam.length * std::floor((x - seam.low) / seam.length);
    x = seam.grain * std::rint(x / seam.grain);
    if (x < seam.low) x += seam.length;
    return x < seam.low + seam.length ? x : x - seam.length;
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
NATATOR_HD Vec3<R> to_tank(const Seam<R>& seam, const Vec3<R>& x) {
    return with(x, seam.axis, to_tank(seam, along(x, seam.axis)));
}

/// Water itself is put back only where it has left.
template <class R>
NATATOR_HD Vec3<R> wrapped(const Seam<R>& seam, const Vec3<R>& x) {
    return in_tank(seam, along(x, seam.axis)) ? x : to_tank(seam, x);
}

}  // namespace NATATOR_SET
}  // namespace natator::physics
