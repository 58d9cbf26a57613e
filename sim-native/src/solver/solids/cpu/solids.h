#pragma once

#include <vector>

#include "natator/model.h"

namespace natator::cpu {

/// At which solids are pushed apart that overlap, length/s^2: max_acceleration, but enough to win against gravity.
/// Unlimited only nominally, so that it can be multiplied.
double overlap_acceleration(const SolverParameters& parameters);

/// Groups of particles that springs and clusters hang together; none with a particle of infinite mass.
std::vector<std::vector<int>> free_bodies(const Model& model);

/// A cluster with the masses m_j / n_j, n_j = clusters of particle j, and rest offsets about their centre.
template <class Real>
struct SplitCluster {
    std::vector<Real> mass;
    std::vector<Vector3<Real>> offset;
};
template <class Real>
std::vector<SplitCluster<Real>> split_clusters(const Model& model);

}  // namespace natator::cpu
