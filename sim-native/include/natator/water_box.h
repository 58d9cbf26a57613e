#pragma once

#include <Eigen/Core>

namespace natator {

/// What water meets at an end of its box.
enum class WaterFace { periodic, free_slip, no_slip };

/// Water on a lattice of cubic cells, as scheme `lattice` has it.
struct WaterBox {
    Eigen::Vector3i cells{1, 1, 1};   ///< along x, y, z
    double cell = 1;                  ///< edge of a cell, length
    Eigen::Vector3d corner{0, 0, 0};  ///< the lowest, length
    WaterFace faces[3][2] = {};       ///< along x, y, z: below, above; both periodic or none
    double viscosity = 0.001;         ///< kinematic, length^2/s, above 0
    double density = 1;               ///< mass/length^3

    double cell_mass() const { return density * cell * cell * cell; }
};

}  // namespace natator
