#pragma once

#include "triangle_mesh.h"

namespace natator {

/// Particles inside a mesh that check_mesh has passed, with x forward, y up and z right, on a cubic lattice in the
/// middle of the mesh's box: their places from that middle, in the mesh's units. Inside is where the winding number
/// along a line is 1, as in slice_mesh. Throws InputError as MeshLattice and check_volume do, and for more than
/// limits::particles.
std::vector<Eigen::Vector3d> points_inside(const TriangleMesh& mesh, double spacing);

}  // namespace natator
