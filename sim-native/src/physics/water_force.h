// Scheme `conserving`: what the water does to a solid, pair by pair, where someone asks for it.
#pragma once

#include "pair.h"

namespace natator::physics::inline NATATOR_SET {

/// One particle of a pair, as forces need it.
template <class T>
struct PairSide {
    T volume;
    T impulse;                        ///< sum of its pressure impulses in the substep
    Vec3<T> zeroth_order_correction;  ///< E times zeroth_order_share, see zeroth_order_correction
};

/// Impulse of all pressure passes of a substep on the first of a pair, by the second, and of what both are given back
/// of the other's zeroth_order_correction. `pair_gradient`: G_ij; `weight`: W_ij.
template <class T>
NATATOR_HD Vec3<T> pressure_impulse_between(const PairSide<T>& own, const PairSide<T>& other,
                                            const Vec3<T>& pair_gradient, T weight) {
    return weight * (other.volume * own.zeroth_order_correction - own.volume * other.zeroth_order_correction) -
           (own.impulse + other.impulse) * pair_gradient;
}

}  // namespace natator::physics::inline NATATOR_SET
