#include "rotation_fit.h"

#include <cmath>

namespace natator::cpu {

void fit_rotation(const Eigen::Matrix3d& covariance, Eigen::Quaterniond& rotation, int steps) {
    constexpr double epsilon = 1e-9;
    for (int step = 0; step < steps; ++step) {
        const Eigen::Matrix3d r = rotation.toRotationMatrix();
        Eigen::Vector3d omega = Eigen::Vector3d::Zero();
        for (int k = 0; k < 3; ++k) omega += r.col(k).cross(covariance.col(k));
        omega /= std::abs((r.array() * covariance.array()).sum()) + epsilon;
        const double angle = omega.norm();
        if (angle < epsilon) return;
        rotation = Eigen::AngleAxisd(angle, omega / angle) * rotation;
        rotation.normalize();
    }
}

}  // namespace natator::cpu
