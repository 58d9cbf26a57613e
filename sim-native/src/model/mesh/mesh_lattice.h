#pragma once

#include <string>
#include <vector>

#include "exact_grid.h"
#include "triangle_mesh.h"

namespace natator {

/// The lattice in the box of a mesh: slice 0 is nearest the head.
class MeshLattice {
public:
    MeshLattice(const TriangleMesh& mesh, double spacing);

    const ExactGrid& grid() const { return grid_; }
    const Eigen::Vector3i& count() const { return count_; }
    double x(double slice) const { return middle_.x() + ((count_.x() - 1) / 2.0 - slice) * spacing_; }
    double y(int row) const { return middle_.y() + (row - (count_.y() - 1) / 2.0) * spacing_; }
    double z(int column) const { return middle_.z() + (column - (count_.z() - 1) / 2.0) * spacing_; }
    const Eigen::Vector3d& middle() const { return middle_; }

    /// Number of a place along an axis, not rounded; slices from the head.
    double slice(double at) const { return (count_.x() - 1) / 2.0 - (at - middle_.x()) / spacing_; }
    double row(double at) const { return (count_.y() - 1) / 2.0 + (at - middle_.y()) / spacing_; }
    double column(double at) const { return (count_.z() - 1) / 2.0 + (at - middle_.z()) / spacing_; }
    /// Half spacings of a column from the middle.
    int from_middle(int column) const { return 2 * column - (count_.z() - 1); }
    /// "0.3 of the length".
    std::string part(double slice) const;

private:
    ExactGrid grid_;
    double spacing_;
    Eigen::Vector3i count_;
    Eigen::Vector3d middle_;
};

/// Where a line of the lattice goes through a face.
struct Crossing {
    double x;
    int step;  ///< of the winding number, towards larger x
};

/// What the lines of the lattice along x go through, by row and column.
///
/// Which faces a line goes through is told by exact signs; a line through an edge or a corner is moved aside by
/// symbolic perturbation (Edelsbrunner, Mücke: Simulation of Simplicity, 1990), so that it counts once.
std::vector<std::vector<Crossing>> crossings_of(const TriangleMesh& mesh, const MeshLattice& lattice);

/// Numbers of the slices that are inside on one line, appended to `inside`; sorts the line's crossings. Throws
/// InputError where the winding number is neither 0 nor 1.
void add_inside(std::vector<Crossing>& line, const MeshLattice& lattice, int row, int column, std::vector<int>& inside);

/// Throws InputError if so many particles have a volume that is far from the mesh's.
void check_volume(double particles, double spacing, double volume);

}  // namespace natator
