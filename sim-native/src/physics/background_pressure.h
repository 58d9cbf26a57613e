// Scheme `conserving`: water whose weight is carried by a hydrostatic pressure that is known beforehand, so that its
// pressure solves look for what is left, the modified pressure (Batchelor: An Introduction to Fluid Dynamics, 1967,
// section 4.1).
#pragma once

#include "dfsph.h"

namespace natator::physics::inline NATATOR_SET {

/// The hydrostatic pressure q(d) of a depth d below some level, d = down . x - begin: 0 above it, rho g d^2/(2 w) as
/// far as to d = w, rho g (d - w/2) beyond. Its gradient subtracts the part min(d/w, 1) from the water's weight, and
/// pushes solids in the water up by as much as it subtracts from the weight of water of their volume.
template <class T>
struct CarriedWeight {
    Vec3<T> gravity{};  ///< what of the fluid's gravity is carried deep down, length/s^2; 0: nothing is
    Vec3<T> down{};     ///< its direction, a unit vector
    T begin{};          ///< length
    T width = 1;        ///< w, length

    NATATOR_HD bool any() const { return dot(gravity, gravity) > 0; }

    /// The part of the weight that is carried at x.
    NATATOR_HD T part(const Vec3<T>& x) const { return unit_part((dot(down, x) - begin) / width); }

    /// Acceleration that is subtracted from a particle's at x, length/s^2. `density`: of the fluid, mass/length^3.
    NATATOR_HD Vec3<T> acceleration(const Vec3<T>& x, bool fluid, T density, T volume, T inverse_mass) const {
        return (part(x) * (fluid ? T(1) : density * volume * inverse_mass)) * gravity;
    }

    /// Force on a solid of this volume at x, mass length/s^2: against gravity.
    NATATOR_HD Vec3<T> lift(const Vec3<T>& x, T density, T volume) const {
        return (part(x) * -density * volume) * gravity;
    }

    /// q at x, mass/(length s^2).
    NATATOR_HD T pressure(const Vec3<T>& x, T density) const {
        const T deep = positive_part(dot(down, x) - begin), edge = minimum(deep, width);
        return density * norm(gravity) * (deep - edge + edge * edge / (2 * width));
    }
};

}  // namespace natator::physics::inline NATATOR_SET
