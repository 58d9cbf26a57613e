// Pairs of fluid particles, `difference` from particle j to particle i.
#pragma once

#include "constants.h"
#include "vec3.h"

namespace natator::physics {

/// Distance r of a pair and 1/r, which stays finite at r = 0, where the direction is 0 anyway.
template <class T>
struct Distance {
    T r, inverse_r;
};

inline namespace NATATOR_SET {

/// Always rounded in this order, whatever a compiler would fuse.
template <class T>
NATATOR_HD T squared_length(const Vec3<T>& v) {
    return fused(v.z, v.z, fused(v.x, v.x, v.y * v.y));
}

/// The pair's distance with 1/r where that is known already.
template <class T>
NATATOR_HD Distance<T> distance_by(const Vec3<T>& difference, T inverse_r) {
    return {squared_length(difference) * inverse_r, inverse_r};
}

template <class T>
NATATOR_HD Distance<T> distance_of(const Vec3<T>& d) {
#if defined(__CUDA_ARCH__)
    const T r2 = d.x * d.x + (d.y * d.y + (d.z * d.z + T(min_square)));
    const T inverse_r = inverse_root(r2);
    return {r2 * inverse_r, inverse_r};
#else
    return distance_by(d, 1 / square_root(squared_length(d) + Scalar<T>(min_square)));
#endif
}

/// The distance alone.
template <class T>
NATATOR_HD T length_of(const Vec3<T>& d) {
#if defined(__CUDA_ARCH__)
    return distance_of(d).r;
#else
    return square_root(squared_length(d) + Scalar<T>(min_square));
#endif
}

}  // namespace NATATOR_SET
}  // namespace natator::physics
