#pragma once

#include <optional>
#include <string>
#include <vector>

#include "natator/model.h"
#include "physics/carried_weight.h"

namespace natator {

/// Why these planes and periodic axes are no tank that modifiedPressure could find the water's surface in; empty if they are one.
/// `gravity`: of the fluid; along its largest component there must be a floor, along the other two ends.
std::optional<std::string> no_tank(const Eigen::Vector3d& gravity, const std::vector<Plane>& planes,
                                   const std::vector<PeriodicAxis>& periodic);

/// What of the water's weight its solver does not have to carry; nothing unless the Model asks for it by modifiedPressure. The level
/// is one kernel support R below the surface that all water has at rest in the tank, and w = R: above it the solver must be able
/// to push water back by its own weight. Throws InputError without such a tank.
template <class Real>
physics::CarriedWeight<Real> carried_weight(const Model& model);

/// The depth of water that weighs as much as what the solver has to carry, length; all of it where nothing is carried.
double solved_depth(const Model& model);

}  // namespace natator
