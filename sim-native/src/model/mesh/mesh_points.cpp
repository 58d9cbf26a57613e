#include "mesh_points.h"

#include "mesh_lattice.h"
#include "natator/error.h"
#include "natator/limits.h"

namespace natator {

std::vector<Eigen::Vector3d> points_inside(const TriangleMesh& mesh, double spacing) {
    const MeshLattice lattice(mesh, spacing);
    std::vector<std::vector<Crossing>> lines = crossings_of(mesh, lattice);
    std::vector<Eigen::Vector3d> points;
    std::vector<int> slices;
    for (int row = 0; row < lattice.count().y(); ++row)
        for (int column = 0; column < lattice.count().z(); ++column) {
            slices.clear();
            add_inside(lines[static_cast<std::size_t>(row) * lattice.count().z() + column], lattice, row, column,
                       slices);
            for (const int slice : slices)
                points.push_back(Eigen::Vector3d(lattice.x(slice), lattice.y(row), lattice.z(column)) -
                                 lattice.middle());
            if (points.size() > limits::particles)
                throw InputError("holds more than " + std::to_string(limits::particles) +
                                 " particles at this spacing; see unit and length");
        }
    check_volume(static_cast<double>(points.size()), spacing, signed_volume(mesh));
    return points;
}

}  // namespace natator
