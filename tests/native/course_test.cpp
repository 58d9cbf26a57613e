// Where a body went and how it lies, for bodies that were put there.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "natator/measure.h"

namespace natator {
namespace {

/// A body of 3 x 2 x 2 particles that heads along +x, and as it lies after a rotation and a way.
struct Moved {
    Model model;
    State<double> end;
    double distance = 0;

    Moved(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& way) {
        for (int x = 0; x < 3; ++x)
            for (int y = 0; y < 2; ++y)
                for (int z = 0; z < 2; ++z) model.position.push_back(Eigen::Vector3d(0.5 * x, 0.2 * y, 0.2 * z));
        const Eigen::Vector3d centre(0.5, 0.1, 0.1);
        for (int i = 0; i < 12; ++i) {
            model.body.particles.push_back(i);
            end.position.push_back(rotation * (model.position[i] - centre) + centre + way);
        }
        distance = way.x();
    }
    Course course() const { return course_of(model, model.body, end, distance); }
};

Eigen::Matrix3d turned(double angle, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

TEST(Course, AStraightSwimmerGoesForwardWhatItGoesAlongX) {
    const Course course = Moved(Eigen::Matrix3d::Identity(), {0.4, 0.02, 0.1}).course();
    EXPECT_NEAR(course.forward, 0.4, 1e-12);
    EXPECT_NEAR(course.yaw, 0, 1e-12);
    EXPECT_NEAR(course.roll, 0, 1e-12);
}

/// On a circle of radius R a turn by an angle a ends 2 R sin(a/2) from its start, along the bisector.
TEST(Course, OnAnArcForwardIsTheChord) {
    for (const double turn : {0.5, -1.0, 3.0}) {
        const double radius = 0.7, to_right = turn;
        const Eigen::Vector3d way(radius * std::sin(std::abs(turn)), 0,
                                  std::copysign(radius * (1 - std::cos(turn)), turn));
        const Course course = Moved(turned(-to_right, Eigen::Vector3d::UnitY()), way).course();
        EXPECT_NEAR(course.yaw, turn, 1e-9);
        EXPECT_NEAR(course.forward, 2 * radius * std::sin(std::abs(turn) / 2), 1e-9) << turn;
        EXPECT_NEAR(course.roll, 0, 1e-9);
    }
}

TEST(Course, ARollIsAboutTheHeading) {
    const Eigen::Matrix3d right_side_down = turned(0.6, Eigen::Vector3d::UnitX());
    EXPECT_NEAR(Moved(right_side_down, {0.1, 0, 0}).course().roll, 0.6, 1e-9);
    const Course both = Moved(turned(-0.8, Eigen::Vector3d::UnitY()) * right_side_down, {0.1, 0, 0}).course();
    EXPECT_NEAR(both.roll, 0.6, 1e-9);
    EXPECT_NEAR(both.yaw, 0.8, 1e-9);
}

/// A bend to one side and the other is no turn.
TEST(Course, ABendIsNoTurn) {
    Moved bent(Eigen::Matrix3d::Identity(), {0.4, 0, 0});
    for (int i = 0; i < 12; ++i) bent.end.position[i].z() += i / 4 == 1 ? 0.1 : -0.05;
    EXPECT_NEAR(bent.course().yaw, 0, 1e-9);
    EXPECT_NEAR(bent.course().roll, 0, 1e-9);
}

}  // namespace
}  // namespace natator
