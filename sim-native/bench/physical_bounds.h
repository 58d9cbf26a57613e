#pragma once

#include "natator/gait.h"
#include "natator/model.h"

namespace natator::bench {

/// What gravity and muscles can do to a scene's particles at most; more is the numerics' doing.
struct PhysicalBounds {
    double speed = 0;           ///< length/s
    double kinetic_energy = 0;  ///< mass length^2/s^2
};

/// A run that exceeds the reachable speed this often is taken to have diverged.
inline constexpr double speed_margin = 3;

/// Speed: speed_margin times (fall over the particles' extent along gravity, sqrt(2 g H), plus the fastest change of a
/// muscle's length, pi f a |z| l of its sine). Energy: all mass at a third of that speed bound.
/// A shock that no force makes, such as overlapping particles pushed apart, adds nothing to the bound.
PhysicalBounds physical_bounds(const Model& model, const Gait& gait);

}  // namespace natator::bench
