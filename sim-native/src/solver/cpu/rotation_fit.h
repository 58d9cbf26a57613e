#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace natator::cpu {

/// Turns `rotation` towards the rotation closest to `covariance` (sum of current arm times rest arm transposed) by at
/// most `steps` steps of Müller, Bender, Chentanez, Macklin: A Robust Method to Extract the Rotational Part of
/// Deformations (2016), algorithm 1: omega = sum of r_k x a_k / (|sum of r_k . a_k| + epsilon), k over the columns.
void fit_rotation(const Eigen::Matrix3d& covariance, Eigen::Quaterniond& rotation, int steps);

}  // namespace natator::cpu
