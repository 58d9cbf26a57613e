#pragma once

#include "natator/solver.h"

namespace natator {

/// Calls move(), which may move the particles of a State on the CPU with its tank: then so is the water of scheme
/// lattice. Whether it did.
template <class Real, class Move>
bool move_tank(Solver<Real>& solver, const State<Real>& state, const Move& move) {
    const Vector3<Real> before = state.position.front();
    move();
    const Vector3<Real> by = before - state.position.front();
    if (!by.isZero(0)) solver.shift_water(by.template cast<double>());
    return !by.isZero(0);
}

}  // namespace natator
