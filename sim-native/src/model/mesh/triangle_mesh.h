#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace natator {

/// Triangles as a file has them, in its units.
struct TriangleMesh {
    std::vector<Eigen::Vector3d> vertices;   ///< no two in the same place
    std::vector<Eigen::Vector3i> triangles;  ///< corners go round counter-clockwise seen from outside
    /// of each triangle: its line in the file, or its number if that is binary
    std::vector<long> source;
    bool has_lines = true;  ///< whether `source` counts lines

    Eigen::Vector3d corner(std::size_t triangle, int i) const {
        return vertices[static_cast<std::size_t>(triangles[triangle][i])];
    }
    /// "the face of line 12", "facet 3".
    std::string name(std::size_t triangle) const;
};

/// "the face of line 12", "facet 3".
std::string face_name(long source, bool has_lines);

/// "(0.1, 0.2, 0.3)".
std::string shown(const Eigen::Vector3d& place);

/// Volume inside a closed mesh, less than 0 if its faces look inwards.
double signed_volume(const TriangleMesh& mesh);

/// Whether a file's name ends in .obj or .stl, in small letters or large ones.
bool is_obj(const std::string& name);
bool is_stl(const std::string& name);

/// A mesh of its file's bytes: Wavefront .obj if `name` ends so, else .stl, text or binary. Throws InputError that says
/// where: numbers that are none or not finite, corners that are not there, an end in the middle, more than
/// limits::mesh_faces, and what triangles_of refuses.
///
/// The readers are our own. tinyobjloader and assimp take a number that is none for 0, tell no line of a face, and
/// leave holes where a face has corners on a straight edge or repeats one; assimp reads in single precision and is 10
/// MB.
TriangleMesh read_mesh(const std::string& bytes, const std::string& name);

}  // namespace natator
