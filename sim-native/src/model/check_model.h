#pragma once

#include <vector>

#include "natator/model.h"

namespace natator {

/// Throws InputError unless a model's lists belong together: as many velocities, masses and phases as positions, and
/// springs, clusters, muscles and bodies of particles, springs and actuators that are there; and unless kernel_support
/// and the ratio of radius and fluid_rest_distance are within their limits.
void check_model(const Model& model);

/// Throws InputError unless there is a value for each of the body's actuators, or of all swimmers'.
void check_driven(const Model& model, const std::vector<double>& driven);

/// Throws InputError unless time goes on, and in at least one substep.
void check_step(double time_step, int substeps);

/// Throws InputError for more threads than limits::threads.
void check_threads(int threads);

/// Throws InputError unless all of these are particles of a model.
void check_particles(const Model& model, const std::vector<int>& particles);

/// Throws InputError unless a state has a place for each particle of its model: for what reads no more of it.
template <class Real>
void check_places(const Model& model, const State<Real>& state);

/// The same for a rest length of each spring.
template <class Real>
void check_springs(const Model& model, const State<Real>& state);

/// The same for a place and a velocity of each particle.
template <class Real>
void check_places_and_velocities(const Model& model, const State<Real>& state);

/// Throws InputError unless a state has as many particles, clusters and springs as its model.
template <class Real>
void check_state(const Model& model, const State<Real>& state);

}  // namespace natator
