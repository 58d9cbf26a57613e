// What is read off a state.
#include <gtest/gtest.h>

#include "natator/measure.h"

namespace natator {
namespace {

template <class Real>
State<Real> two_particles() {
    State<Real> state;
    state.position = {{Real(1), Real(2), Real(3)}, {Real(-0.5), Real(0.25), Real(1e-3)}};
    state.velocity = {{Real(4), Real(5), Real(6)}, {Real(0), Real(-0.0), Real(7)}};
    return state;
}

/// Worked out byte by byte with the published constants of FNV-1a in another language.
TEST(MeasureTest, HashIsFnv1aOverPositionsThenVelocities) {
    EXPECT_EQ(state_hash(two_particles<float>()), 0xbea00804b308f103u);
    EXPECT_EQ(state_hash(two_particles<double>()), 0x841a42dae4f72546u);
    EXPECT_EQ(state_hash(State<float>{}), 0xcbf29ce484222325u);
}

TEST(MeasureTest, HashSeesEveryBit) {
    const State<float> state = two_particles<float>();
    State<float> other = state;
    other.velocity[1].y() = 0.0f;  // was -0
    EXPECT_NE(state_hash(other), state_hash(state));
    other = state;
    std::swap(other.position[0], other.position[1]);
    EXPECT_NE(state_hash(other), state_hash(state));
}

TEST(MeasureTest, MeanXIsOverTheBodyOnly) {
    Body body;
    EXPECT_EQ(mean_x(body, two_particles<double>()), 0);
    body.particles = {1};
    EXPECT_EQ(mean_x(body, two_particles<double>()), -0.5);
    body.particles = {0, 1};
    EXPECT_EQ(mean_x(body, two_particles<float>()), 0.25);
}

TEST(MeasureTest, ABodyTouchesAPlaneAtTheCollisionDistance) {
    Model model;
    model.parameters.collision_distance = 0.05;
    model.planes = {{{-1, 0, 0}, 4.51}, {{0, 1, 0}, 0}};
    model.position.resize(2);
    model.body.particles = {1};
    State<float> state;
    state.position = {{4.5f, 0.0f, 0.0f}, {2.0f, 1.0f, 0.0f}};  // particle 0 touches both planes but is not of the body
    EXPECT_FALSE(touches_plane(model, state));
    state.position[1] = {2.0f, 0.051f, 0.0f};
    EXPECT_FALSE(touches_plane(model, state));
    state.position[1] = {2.0f, 0.05f, 0.0f};
    EXPECT_TRUE(touches_plane(model, state));
    state.position[1] = {2.0f, 0.01f, 0.0f};
    EXPECT_TRUE(touches_plane(model, state));
    state.position[1] = {4.46f, 1.0f, 0.0f};  // 4.51 - 0.05, to within float rounding
    EXPECT_TRUE(touches_plane(model, state));
    state.position[1] = {4.459f, 1.0f, 0.0f};
    EXPECT_FALSE(touches_plane(model, state));
}

/// Masses 1 and 3: (1 (4, 0, 0) + 3 (0, 4, 0)) / 4; the particle that is held in place has no part in it.
TEST(MeasureTest, VelocityOfTheCentreOfMass) {
    Model model;
    model.position.resize(3);
    model.inverse_mass = {1, 1.0 / 3, 0};
    State<float> state;
    state.position.resize(3);
    state.velocity = {{4, 0, 0}, {0, 4, 0}, {9, 9, 9}};
    EXPECT_TRUE(centre_velocity(model, state, {0, 1, 2}).isApprox(Eigen::Vector3d(1, 3, 0)));
    EXPECT_EQ(centre_velocity(model, state, {2}), Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace natator
