#pragma once

#include "triangle_mesh.h"

namespace natator {

/// Refuses, by an InputError that says where, what does not bound a solid: a face without area, an edge that belongs to
/// one face (a hole) or more than two, two faces beside each other that look to different sides, a mesh that is inside
/// out, faces that cut or touch others than their neighbours, and pairs of faces too many to be looked at.
///
/// All signs are exact: vertices are rounded to 2^-30 of the mesh's extent and tested in whole numbers. Two triangles
/// meet if an edge of one meets the other (after Devillers and Guigue, Faster Triangle-Triangle Intersection Tests,
/// 2002).
void check_mesh(const TriangleMesh& mesh);

}  // namespace natator
