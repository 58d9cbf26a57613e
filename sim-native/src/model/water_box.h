#pragma once

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// The water of a scene of scheme `lattice` that has fluid: a cell for each lattice point of its fluid, no slip where a
/// plane stands, free slip at other ends that are not periodic. Throws InputError for what this water has not: planes
/// stand at its ends.
WaterBox water_box(const Scene& scene);

/// Where the body begins, from its place, length: FluidBlock::disorder says it.
Eigen::Vector3d offset_in_cells(const Scene& scene);

}  // namespace natator
