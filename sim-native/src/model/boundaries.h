#pragma once

#include <vector>

#include "natator/model.h"
#include "physics/boundary.h"

namespace natator {

/// All ends of the water in the order in which ghosts are made: those of periodic axes, two each, and then the planes.
template <class Real>
std::vector<physics::Boundary<Real>> boundaries_of(const Model& model);

template <class Real>
std::vector<physics::PeriodicAxis<Real>> periodic_axes_of(const Model& model);

/// Gravity along the axes that have ends: what the water weighs on its walls by, length/s^2.
Eigen::Vector3d gravity_on_walls(const Model& model);
/// The same of parts of a Model, or of a scene.
Eigen::Vector3d gravity_on_walls(const SolverParameters& parameters, const std::vector<PeriodicAxis>& periodic);

/// The difference of two places by the shortest way, through the ends of periodic axes too.
Eigen::Vector3d minimum_image(const Model& model, Eigen::Vector3d difference);

}  // namespace natator
