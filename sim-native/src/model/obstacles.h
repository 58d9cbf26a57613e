#pragma once

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// As many particles as a mesh has, or as the box around a sphere holds.
double most_particles(const Obstacle& obstacle);

/// Adds particles of infinite mass: those of the mesh, or on a cubic lattice about the centre wherever the obstacle holds one.
void add_obstacle(const Obstacle& obstacle, Model& model);

}  // namespace natator
