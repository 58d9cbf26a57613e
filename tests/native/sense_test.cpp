// What a swimmer senses, for bodies and water that were put there.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "natator/error.h"
#include "natator/measure.h"
#include "natator/model.h"

namespace natator {
namespace {

using Eigen::Vector3d;
using Side = SkinPlace::Side;

const Vector3d body_middle(0.5, 0.1, 0.1);

/// A rigid body of 3 slices of 2 x 2 particles that heads along +x, as it lies after a rotation about its body_middle
/// and a way, and moves with a velocity and an angular velocity over ground; a muscle on each side; water all about it.
struct Swimmer {
    Model model;
    State<double> state;

    Swimmer(const Eigen::Matrix3d& rotation, const Vector3d& way, const Vector3d& velocity, const Vector3d& turn) {
        model.parameters.solid_rest_distance = 0.1;
        model.parameters.fluid_rest_distance = 0.1;
        for (int x = 2; x >= 0; --x) {
            model.body.slices.emplace_back();
            for (int y = 0; y < 2; ++y)
                for (int z = 0; z < 2; ++z) add_body_particle({0.5 * x, 0.2 * y, 0.2 * z});
        }
        model.body.length = 1;
        for (std::size_t i = 0; i < model.position.size(); ++i) {
            const Vector3d arm = rotation * (model.position[i] - body_middle);
            state.position.push_back(body_middle + way + arm);
            state.velocity.push_back(velocity + turn.cross(arm));
        }
        model.actuators = 1;
        for (const int side : {0, 1}) {  // left: z = 0
            model.springs.push_back({side, 8 + side, 1, 1});
            model.muscles.push_back({side, 0, side == 0 ? -1.0 : 1.0});
        }
    }
    void add_water(const Vector3d& at, const Vector3d& velocity) {
        model.position.push_back(at);
        model.inverse_mass.push_back(1);
        model.phase.push_back(phase::fluid);
        state.position.push_back(at);
        state.velocity.push_back(velocity);
    }
    Senses senses(const Sensing& sensing = {}) const { return sense(model, state, sensing); }

private:
    void add_body_particle(const Vector3d& at) {
        model.body.slices.back().push_back(static_cast<int>(model.position.size()));
        model.body.particles.push_back(static_cast<int>(model.position.size()));
        model.position.push_back(at);
        model.inverse_mass.push_back(0.5);
        model.phase.push_back(1);
    }
};

Eigen::Matrix3d rotated_by(double angle, const Vector3d& axis) {
    return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

void expect_near(const Vector3d& actual, const Vector3d& expected, const char* what) {
    EXPECT_LT((actual - expected).norm(), 1e-9)
        << what << ": " << actual.transpose() << " not " << expected.transpose();
}

TEST(SenseTest, PoseAndMotionOfARigidBody) {
    const Eigen::Matrix3d rotation = rotated_by(0.9, {0.2, 1, 0.1});
    const Vector3d way(0.3, -0.2, 0.5), velocity(0.7, 0.1, -0.4), turn(0.3, -1.2, 0.5);
    const Senses senses = Swimmer(rotation, way, velocity, turn).senses();
    expect_near(senses.centre, body_middle + way, "centre");
    EXPECT_LT((senses.axes - rotation).norm(), 1e-9);
    expect_near(senses.velocity, rotation.transpose() * velocity, "velocity");
    expect_near(senses.turn_rate, rotation.transpose() * turn, "turn rate");
    EXPECT_FALSE(senses.target);
    EXPECT_TRUE(senses.flow.empty());
}

TEST(SenseTest, TheTargetIsSeenAlongOwnAxes) {
    const Eigen::Matrix3d to_right = rotated_by(-std::numbers::pi / 2, Vector3d::UnitY());  // heads along +z
    const Swimmer swimmer(to_right, {0, 0, 0}, {0, 0, 0}, {0, 0, 0});
    const Senses ahead = swimmer.senses({.target = body_middle + Vector3d(0, 0, 3)});
    expect_near(*ahead.target, {1, 0, 0}, "ahead");
    EXPECT_NEAR(ahead.target_distance, 3, 1e-12);
    expect_near(*swimmer.senses({.target = body_middle + Vector3d(2, 0, 0)}).target, {0, 0, -1}, "to the left");
    expect_near(*swimmer.senses({.target = body_middle + Vector3d(0, 4, 0)}).target, {0, 1, 0}, "above");
    EXPECT_NEAR(swimmer.senses({.target = body_middle}).target_distance, 0, 1e-12);
    EXPECT_TRUE(swimmer.senses({.target = body_middle}).target->allFinite());
}

/// Water of one velocity everywhere flows by each place with that less the place's own.
TEST(SenseTest, FlowIsTheWatersLessTheSkins) {
    const Eigen::Matrix3d rotation = rotated_by(0.6, {0, 1, 0});
    const Vector3d way(0.1, 0.3, -0.2), velocity(0.7, 0.1, -0.4), turn(0, 2, 0), water(-0.5, 0.2, 0.1);
    Swimmer swimmer(rotation, way, velocity, turn);
    const Vector3d left_of_head = rotation * (Vector3d(1, 0.1, 0) - body_middle);
    for (const double out : {0.05, 0.15})
        swimmer.add_water(body_middle + way + left_of_head + rotation * Vector3d(0, 0, -out), water);
    const Senses senses = swimmer.senses({.flow = {{0, Side::left}, {2, Side::right}}});
    ASSERT_EQ(senses.flow.size(), 2u);
    EXPECT_EQ(senses.flow[0].particles, 2);
    expect_near(senses.flow[0].velocity, rotation.transpose() * (water - velocity - turn.cross(left_of_head)), "flow");
    EXPECT_EQ(senses.flow[1].particles, 0);
    expect_near(senses.flow[1].velocity, {0, 0, 0}, "where there is no water");
}

TEST(SenseTest, FlowIsWeightedByDistanceAndEndsWhereItIsAskedTo) {
    Swimmer swimmer(Eigen::Matrix3d::Identity(), {0, 0, 0}, {0, 0, 0}, {0, 0, 0});
    swimmer.add_water({1, 0.3, 0.1}, {1, 0, 0});  // 0.1 above the head's upper side
    swimmer.add_water({1, 0.4, 0.1}, {0, 0, 1});  // 0.2
    const auto above = [&](double within) {
        return swimmer.senses({.flow = {{0, Side::above}}, .within = within}).flow[0];
    };
    EXPECT_EQ(above(0.15).particles, 1);
    expect_near(above(0.15).velocity, {1, 0, 0}, "the nearer one");
    const double near = std::pow(1 - 1.0 / 16, 3), far = std::pow(1 - 4.0 / 16, 3);
    expect_near(above(0.4).velocity, Vector3d(near, 0, far) / (near + far), "both");
    EXPECT_EQ(above(0).particles, 2);  // within 0.1 + 2 * 0.1
    EXPECT_EQ(swimmer.senses({.flow = {{0, Side::below}}, .within = 0.15}).flow[0].particles, 0);
}

TEST(SenseTest, BendIsTheDriveThatTheMusclesFollow) {
    Swimmer swimmer(Eigen::Matrix3d::Identity(), {0, 0, 0}, {0, 0, 0}, {0, 0, 0});
    EXPECT_NEAR(swimmer.senses().bend.at(0), 0, 1e-12);
    for (const double drive : {0.6, -0.3}) {  // length = 1 + drive / 2 on the right, 1 - drive / 2 on the left
        swimmer.state.position[8].x() = 1 - (1 - drive / 2);
        swimmer.state.position[9].x() = 1 - (1 + drive / 2);
        EXPECT_NEAR(swimmer.senses().bend.at(0), drive, 1e-12);
    }
    const double own = swimmer.senses().bend[0];
    swimmer.model.springs.push_back({2, 10, 3, 1});  // of a companion
    swimmer.model.muscles.push_back({2, 1, 1.0});
    EXPECT_EQ(swimmer.senses().bend, std::vector<double>{own});
}

/// A moving tank's coordinates begin elsewhere: places are over ground, the water about the skin is the same.
TEST(SenseTest, PlacesAreOverGround) {
    Swimmer swimmer(rotated_by(0.3, {0, 1, 0}), {0.1, 0, 0}, {0.2, 0, 0}, {0, 0, 0});
    swimmer.add_water(swimmer.state.position[0] + Vector3d(0, 0.1, 0), {0, 1, 0});
    const Sensing sensing{.flow = {{0, Side::above}}, .target = Vector3d(9, 1, 2)};
    const Senses here = swimmer.senses(sensing);
    swimmer.state.origin = Vector3d(4, 0, -1);
    const Senses there = swimmer.senses(sensing);
    expect_near(there.centre, here.centre + swimmer.state.origin, "centre");
    EXPECT_NEAR(there.target_distance, (Vector3d(9, 1, 2) - there.centre).norm(), 1e-12);
    EXPECT_LT((there.axes - here.axes).norm(), 1e-9);
    EXPECT_EQ(there.flow[0].particles, 1);
    expect_near(there.flow[0].velocity, here.flow[0].velocity, "flow");
}

TEST(SenseTest, FloatsAreReadAsTheyAre) {
    const Swimmer swimmer(rotated_by(0.4, {0, 1, 0}), {0.1, 0.2, 0.3}, {0.5, 0, 0}, {0, 1, 0});
    State<float> state;
    for (const Vector3d& position : swimmer.state.position) state.position.push_back(position.cast<float>());
    for (const Vector3d& velocity : swimmer.state.velocity) state.velocity.push_back(velocity.cast<float>());
    EXPECT_LT((sense(swimmer.model, state, {}).axes - swimmer.senses().axes).norm(), 1e-6);
}

TEST(SenseTest, WhatCannotBeSensedIsRefused) {
    const Swimmer swimmer(Eigen::Matrix3d::Identity(), {0, 0, 0}, {0, 0, 0}, {0, 0, 0});
    const auto refusal = [](const Sensing& sensing, const Model& model) -> std::string {
        try {
            check_sensing(sensing, model);
        } catch (const InputError& error) {
            return error.what();
        }
        return "accepted";
    };
    EXPECT_EQ(refusal({.flow = {{0, Side::left}, {2, Side::above}}, .within = 0.3, .target = Vector3d(1, 2, 3)},
                      swimmer.model),
              "accepted");
    EXPECT_EQ(refusal({.flow = {{0, Side::left}, {3, Side::left}}}, swimmer.model),
              "flow[1].slice = 3: must be a slice of the body, in [0, 2]");
    EXPECT_EQ(refusal({.within = NAN}, swimmer.model), "within = nan: must be 0 or a length up to 1000");
    EXPECT_EQ(refusal({.target = Vector3d(1, NAN, 0)}, swimmer.model), "target: must be three numbers");
    EXPECT_EQ(refusal({.flow = std::vector<SkinPlace>(1001)}, swimmer.model),
              "flow has length 1001: must have length 1000 at most");
    EXPECT_EQ(refusal({}, Model{}), "sense: the scene has no creature, whose senses they would be");
}

}  // namespace
}  // namespace natator
