#pragma once

#include <cstdint>

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// As many particles as the obstacle's surrounding box holds.
std::int64_t most_particles(const Obstacle& obstacle);

/// Adds particles of infinite mass on a cubic lattice about the obstacle's centre, wherever it holds one.
void add_obstacle(const Obstacle& obstacle, Model& model);

}  // namespace natator
