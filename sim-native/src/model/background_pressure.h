#pragma once

#include <optional>
#include <string>
#include <vector>

#include "natator/model.h"
#include "physics/background_pressure.h"

namespace natator {

/// Why these planes and periodic axes are no tank that modified_pressure could find the water's surface in; empty if
/// they are one. `gravity`: of the fluid; along its largest component there must be a floor, along the other two ends.
std::optional<std::string> no_tank(const Eigen::Vector3d& gravity, const std::vector<Plane>& planes,
                                   const std::vector<PeriodicAxis>& periodic);

/// Largest acceleration by which the water weighs on its walls, length/s^2.
double weight_on_walls(const Model& model);

/// The longest substep in which the passes of a Model hold up water so deep (length) as is not carried otherwise, s.
double max_substep(const Model& model, double depth);

/// The depth of water that weighs as much as what the solver has to carry, length: all of it, but with
/// modified_pressure no more than two thirds of what the passes hold up in the Model's substep.
double solved_depth(const Model& model);
/// The same, with modified_pressure the least: 1.5 kernel supports, as waves must find water that weighs.
double min_solved_depth(const Model& model);

/// What of the water's weight its solver does not have to carry: what solved_depth leaves, nothing unless the Model
/// asks for it by modified_pressure. w is the kernel's support R, and the level solved_depth - R/2 below the surface
/// that all water has at rest in the tank. Throws InputError without such a tank.
template <class Real>
physics::CarriedWeight<Real> background_pressure(const Model& model);

}  // namespace natator
