#pragma once

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// As many particles as a mesh has, or as the box around a sphere holds.
double max_particles(const Obstacle& obstacle);

/// Adds particles of infinite mass: those of a mesh, or on a cubic lattice about the centre wherever an obstacle holds
/// one. Where obstacles touch or overlap, the first one's: particles that lie in each other have no volume, and let
/// water through. How many each has.
std::vector<int> add_obstacles(const std::vector<Obstacle>& obstacles, Model& model);

}  // namespace natator
