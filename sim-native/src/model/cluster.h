#pragma once

#include "natator/model.h"

namespace natator {

/// A shape-matching cluster of `particles` whose shape is that of `rest_position` (by particle of the model).
Cluster make_cluster(std::vector<int> particles, const std::vector<Eigen::Vector3d>& rest_position, double stiffness);

}  // namespace natator
