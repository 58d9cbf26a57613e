#pragma once

#include <vector>

#include "triangle_mesh.h"

namespace natator {

constexpr double max_coordinate = 1e9;  // of a file's units; a float's 7 digits mean little beyond

/// Faces of any number of corners, as a file has them, in its units.
struct PolygonMesh {
    std::vector<Eigen::Vector3d> vertices;
    std::vector<std::vector<int>> faces;  ///< corners go round counter-clockwise seen from outside
    std::vector<long> source;             ///< of each face, as in TriangleMesh
    bool has_lines = true;                ///< as in TriangleMesh
};

/// Triangles of polygons, without what files have that says nothing of the solid: vertices that no face uses, or
/// several within 1e-6 of the largest extent, corners that a face repeats, faces without area. If edges belong to one
/// face alone, vertices there that are up to 1e-4 apart become one, and those in the middle of a straight edge of the
/// face beside become its corners, by as little as closes the mesh; if nothing does, it stays as it is.
///
/// What comes out does not depend on the corner that a face begins with. Throws InputError: no face that has an area,
/// an outline that cuts itself, outlines that are too long to be cut up in some seconds.
TriangleMesh triangles_of(PolygonMesh mesh);

}  // namespace natator
