#pragma once

#include "natator/scene.h"
#include "triangle_mesh.h"

namespace natator {

/// A body's slices, and where they are in the mesh.
struct MeshSlices {
    std::vector<Slice> slices;    ///< from the head on
    Eigen::Vector3d rear_centre;  ///< of the last slice, on the middle of the mesh's box; in the mesh's units
    double volume = 0;            ///< inside the mesh, its units^3
};

/// Particles inside a mesh that check_mesh has passed, with x forward, y up and z right, on a cubic lattice of this
/// spacing in the middle of the mesh's box. The left half is sampled and mirrored (thesis 4.4), with as many columns
/// left as right.
///
/// Along each line of the lattice the winding number counts the faces that it goes through (Jacobson, Kavan,
/// Sorkine-Hornung: Robust Inside-Outside Segmentation using Generalized Winding Numbers, 2013, for closed meshes): 1
/// inside.
///
/// Slices at the tips that are less than two particles high or wide are left out, two at each end at most. Refuses by
/// an InputError that says where: fewer than 2 or more than 1000 spacings along any axis, more than limits::particles,
/// a part of the body thinner than two particles, or of its surface far from all of them, a left and a right half that
/// differ, faces of a part that looks inwards, and a volume of the particles that is far from the mesh's.
MeshSlices slice_mesh(const TriangleMesh& mesh, double spacing);

}  // namespace natator
