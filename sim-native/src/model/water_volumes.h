#pragma once

#include <vector>

#include "natator/model.h"

namespace natator {

/// Volume of each particle, length^3. Of a fluid particle what makes the density of a cubic lattice at the rest
/// distance 1; of a solid one the cube of the distance to the nearest other of its group at rest, but no more than
/// that.
std::vector<double> particle_volumes(const Model& model);

/// Mass density of the fluid, from the mean mass of its particles, mass/length^3; 0 without any that moves.
double fluid_density(const Model& model, const std::vector<double>& volumes);

/// How far the fluid reaches along a direction of length 1, length; 0 without any.
double extent_of_fluid(const Model& model, const Eigen::Vector3d& direction);

/// Of the fluid along the gravity that presses it on walls, length; 0 without.
double depth(const Model& model);

/// Rate at which velocities may remove an excess of density, 1/s: see physics::velocity_excess. The surface rises at
/// this times the depth, so deep water expands more slowly: it would throw itself up without end. `depth`: see there.
double max_expansion_rate(const SolverParameters& parameters, double depth);

/// R: where the kernel of the water ends, length.
double support(const Model& model);

/// R of physics/water_effects.h, length.
double effect_radius(const Model& model);

/// W(r) of physics::WendlandKernel with this support, 1/length^3.
double wendland(double r, double radius);

}  // namespace natator
