#pragma once

#include <Eigen/Core>

namespace natator::lattice {

/// What water meets at an end of its box.
enum class Face { periodic, free_slip, no_slip };

/// A box of water on a lattice of cubic cells.
struct Box {
    Eigen::Vector3i cells{1, 1, 1};
    double cell = 1;                          ///< length
    Eigen::Vector3d corner{0, 0, 0};          ///< the lowest, length
    Face faces[3][2] = {};                    ///< along x, y, z: below, above; both periodic or none
    double viscosity = 0.001;                 ///< kinematic, length^2/s, above 0
    double density = 1;                       ///< mass/length^3

    long count() const { return static_cast<long>(cells.x()) * cells.y() * cells.z(); }
    double cell_mass() const { return density * cell * cell * cell; }
};

}  // namespace natator::lattice
