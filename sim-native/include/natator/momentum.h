#pragma once

#include <vector>

#include "natator/model.h"
#include "natator/state.h"

namespace natator {

/// Momentum of movable particles, beside the sizes that it is a sum of.
struct Momentum {
    double linear = 0;        ///< |sum of m v|, mass length/s
    double angular = 0;       ///< |sum of m (x - c) x v| about the centre of mass c, mass length^2/s
    double linear_size = 0;   ///< sum of |m v|
    double angular_size = 0;  ///< sum of |m (x - c) x v|
};

/// Momentum of the movable ones of the given particles.
template <class Real>
Momentum measure_momentum(const Model& model, const State<Real>& state, const std::vector<int>& particles);

/// Velocity of the centre of mass of the movable ones of the given particles, length/s; 0 without any.
template <class Real>
Eigen::Vector3d centre_velocity(const Model& model, const State<Real>& state, const std::vector<int>& particles);

/// Momentum of all movable particles.
template <class Real>
Momentum measure_momentum(const Model& model, const State<Real>& state);

}  // namespace natator
