// The rotation of a cluster beside that of a singular value decomposition.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "physics/rotation_fit.h"

namespace natator {
namespace {

class RotationFit : public ::testing::Test {
protected:
    Eigen::Vector3d direction() {
        return Eigen::Vector3d(normal_(random_), normal_(random_), normal_(random_)).normalized();
    }
    Eigen::Quaterniond rotation() {
        return Eigen::Quaterniond(normal_(random_), normal_(random_), normal_(random_), normal_(random_)).normalized();
    }
    double between(double least, double most) { return std::uniform_real_distribution(least, most)(random_); }

    /// Of a turned and deformed cluster, whose second moments along its own axes are these.
    Eigen::Matrix3d covariance(const Eigen::Vector3d& moments) {
        const Eigen::Matrix3d axes = rotation().toRotationMatrix();
        return rotation().toRotationMatrix() * axes * moments.asDiagonal() * axes.transpose();
    }

private:
    std::mt19937 random_{7};
    std::normal_distribution<double> normal_;
};

Eigen::Matrix3d by_decomposition(const Eigen::Matrix3d& a) {
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(a, Eigen::ComputeFullU | Eigen::ComputeFullV);
    const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant();
    return svd.matrixU() * Eigen::Vector3d(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
}

Eigen::Matrix3d closest(const Eigen::Matrix3d& a, Eigen::Quaterniond from) {
    physics::Covariance covariance;
    for (int e = 0; e < 9; ++e) covariance.entry[e] = a(e / 3, e % 3);
    physics::closest_rotation(covariance, from.coeffs().data());
    EXPECT_NEAR(from.norm(), 1, 1e-15);
    return from.toRotationMatrix();
}

Eigen::Quaterniond turned(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& axis, double angle) {
    return Eigen::AngleAxisd(angle, axis) * Eigen::Quaterniond(rotation);
}

TEST_F(RotationFit, IsThatOfADecomposition) {
    for (int k = 0; k < 1000; ++k) {
        const Eigen::Matrix3d a = between(1e-6, 1e6) * covariance({1, between(0.01, 1), between(0.01, 1)});
        const Eigen::Matrix3d exact = by_decomposition(a);
        EXPECT_LT((closest(a, turned(exact, direction(), between(0, 0.5))) - exact).norm(), 1e-12);
    }
}

/// A flat cluster has one, too, and one that is inside out by less than it is wide.
TEST_F(RotationFit, IsThatOfADecompositionWhereTheClusterIsFlat) {
    for (int k = 0; k < 1000; ++k) {
        const Eigen::Matrix3d a = covariance({1, between(0.3, 1), between(-0.2, 0)});
        const Eigen::Matrix3d exact = by_decomposition(a);
        EXPECT_LT((closest(a, turned(exact, direction(), between(0, 0.2))) - exact).norm(), 1e-12);
    }
}

/// The forces of a cluster have no moment, so that it keeps its angular momentum, where A R^T is symmetric.
TEST_F(RotationFit, HasNoMomentFromFarAway) {
    for (int k = 0; k < 1000; ++k) {
        const Eigen::Matrix3d a = covariance({1, between(0.5, 1), between(0.5, 1)});
        const Eigen::Matrix3d moment = a * closest(a, turned(by_decomposition(a), direction(), 2.5)).transpose();
        EXPECT_LT((moment - moment.transpose()).norm(), 1e-14);
        EXPECT_GT(moment.trace(), 0);
    }
}

/// What lies on a line turns with it, and about it as it was.
TEST_F(RotationFit, LeavesAStraightLinesRollAsItWas) {
    for (int k = 0; k < 1000; ++k) {
        const Eigen::Vector3d rest = direction();
        const Eigen::Quaterniond before = rotation();
        const Eigen::Vector3d axis = direction().cross(before * rest).normalized();
        const Eigen::Matrix3d exact = turned(before.toRotationMatrix(), axis, 0.3).toRotationMatrix();
        EXPECT_LT((closest(exact * rest * rest.transpose(), before) - exact).norm(), 1e-7);
    }
}

/// Without any extent it stays as it was.
TEST_F(RotationFit, LeavesAPointAsItWas) {
    const Eigen::Quaterniond before = rotation();
    EXPECT_LT((closest(Eigen::Matrix3d::Zero(), before) - before.toRotationMatrix()).norm(), 1e-15);
}

}  // namespace
}  // namespace natator
