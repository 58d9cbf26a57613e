#pragma once

namespace natator::cpu {

/// A particle counts as touching a plane up to this part of the radius beyond collisionDistance.
inline constexpr double touching_tolerance = 1e-4;

}  // namespace natator::cpu
