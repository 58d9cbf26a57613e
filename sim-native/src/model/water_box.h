#pragma once

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// The water of a scene of scheme `lattice` that has fluid: a cell for each lattice point of its fluid, no slip where a
/// plane stands, at other ends that are not periodic free slip, or open where the current crosses them. Its obstacles
/// are not in it yet. Throws InputError for what this water has not: planes that do not stand at its ends or in the way
/// of the current, a current that goes too far in a substep, obstacles thinner than a cell; in plane flow creatures
/// that are not one particle high, and what is not in the middle of the cells.
WaterBox water_box(const Scene& scene);

/// Whether that water's flow is plane (WaterBox): it is one cell deep along y, without planes there.
bool is_plane_flow(const Scene& scene);
/// Where the body begins, from its place, length: FluidBlock::disorder says it.
Eigen::Vector3d offset_in_cells(const Scene& scene);

}  // namespace natator
