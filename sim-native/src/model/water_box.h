#pragma once

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// The water of a scene of scheme `lattice` that has fluid: a cell for each lattice point of its fluid, no slip where a
/// plane stands, free slip at other ends that are not periodic. Throws InputError for what this water has not: planes
/// stand at its ends.
WaterBox water_box(const Scene& scene);

/// Whether that water's flow is plane (WaterBox): it is one cell deep along y, without planes there.
bool is_plane_flow(const Scene& scene);
/// Throws InputError unless a creature in plane flow is one particle high, in the middle of its cells.
void check_plane_body(const Scene& scene);

/// Where the body begins, from its place, length: FluidBlock::disorder says it.
Eigen::Vector3d offset_in_cells(const Scene& scene);

}  // namespace natator
