// Closed-form mechanics of scheme flex: what must come out whatever the solver is compared with.
#include <gtest/gtest.h>

#include <cmath>

#include "natator/scene.h"
#include "natator/solver.h"

namespace natator {
namespace {

constexpr double dt = 1.0 / 60;

/// Particles with every force, constraint and limit off; tests switch on what they are about.
Model bare_model(std::vector<Eigen::Vector3d> positions) {
    Model model;
    model.scheme = Scheme::flex;
    SolverParameters& p = model.parameters;
    p = thesis_tank().solver;
    p.gravity.setZero();
    p.dynamic_friction = p.particle_friction = 0;
    p.damping = p.flex.viscosity = 0;
    p.max_acceleration = p.max_speed;
    model.time_step = dt;
    model.position = std::move(positions);
    model.velocity.assign(model.position.size(), Eigen::Vector3d::Zero());
    model.inverse_mass.assign(model.position.size(), 1.0);
    model.phase.assign(model.position.size(), 1u);
    return model;
}

template <class Real>
State<Real> run(const Model& model, int updates) {
    Solver<Real> solver(model);
    State<Real> state = initial_state<Real>(model);
    for (int k = 0; k < updates; ++k) EXPECT_FALSE(solver.update(state, model.time_step, model.parameters.substeps));
    return state;
}

/// Symplectic Euler: after n substeps v = n h g and x = h^2 g n (n + 1) / 2, exactly.
TEST(Physics, FreeFallFollowsSymplecticEuler) {
    Model model = bare_model({{0, 10, 0}});
    model.parameters.gravity = {0, -10, 0};
    const int n = 60 * model.parameters.substeps;
    const double h = dt / model.parameters.substeps;
    const auto state = run<double>(model, 60);
    EXPECT_NEAR(state.velocity[0].y(), -10 * n * h, 1e-10);
    EXPECT_NEAR(state.position[0].y(), 10 - 10 * h * h * n * (n + 1) / 2, 1e-10);
    EXPECT_NEAR(state.time, 1.0, 1e-12);
}

/// dv/dt = -c v by explicit Euler: a factor (1 - c h) per substep.
TEST(Physics, DampingIsExponentialDecay) {
    Model model = bare_model({{0, 0, 0}});
    model.velocity[0] = {3, 0, 0};
    model.parameters.damping = 1;
    const auto state = run<double>(model, 60);
    EXPECT_NEAR(state.velocity[0].x(), 3 * std::pow(1 - dt / 4, 240), 1e-10);
    EXPECT_NEAR(state.velocity[0].x(), 3 * std::exp(-1.0), 3e-3);
}

/// One spring of stiffness 1 between unequal masses: the first iteration restores the length, shared by inverse mass,
/// and the centre of mass stays.
TEST(Physics, OneSpringSharesItsCorrectionByInverseMass) {
    Model model = bare_model({{0, 0, 0}, {1, 0, 0}});
    model.inverse_mass = {1.0, 0.25};
    model.springs = {{0, 1, 0.8, 1.0}};
    model.parameters.substeps = 1;
    const auto state = run<double>(model, 1);
    EXPECT_NEAR(state.position[0].x(), 0.2 * 1.0 / 1.25, 1e-12);
    EXPECT_NEAR(state.position[1].x(), 1 - 0.2 * 0.25 / 1.25, 1e-12);
    EXPECT_NEAR(1 * state.velocity[0].x() + 4 * state.velocity[1].x(), 0, 1e-10);
}

/// A stiff spring holds two turning bodies on a circle: one revolution takes 2 pi r / v, and the length stays.
TEST(Physics, TwoBodiesOnASpringTurn) {
    Model model = bare_model({{-0.5, 0, 0}, {0.5, 0, 0}});
    model.springs = {{0, 1, 1.0, 1.0}};
    model.velocity = {{0, -1, 0}, {0, 1, 0}};
    model.parameters.substeps = 64;
    model.time_step = M_PI * 2 * 0.5 / 400;
    const auto state = run<double>(model, 400);
    EXPECT_NEAR((state.position[1] - state.position[0]).norm(), 1.0, 1e-6);
    EXPECT_NEAR(state.position[1].x(), 0.5, 1e-3);
    EXPECT_NEAR(state.position[1].y(), 0.0, 5e-3);
    EXPECT_NEAR((state.position[0] + state.position[1]).norm(), 0, 1e-10);
}

/// Two equal solids that overlap part to solid_rest_distance, each by half of the depth.
TEST(Physics, TwoOverlappingSolidsPart) {
    Model model = bare_model({{0, 0, 0}, {0.1, 0, 0}});
    model.phase = {1u, 2u};
    model.parameters.substeps = 1;
    const auto state = run<double>(model, 1);
    EXPECT_NEAR(state.position[0].x(), -0.025, 1e-12);
    EXPECT_NEAR(state.position[1].x(), 0.125, 1e-12);
}

/// A particle that falls on the floor comes to rest at collision_distance and stays there.
TEST(Physics, AParticleRestsOnTheFloor) {
    Model model = bare_model({{0, 0.3, 0}});
    model.parameters.gravity = {0, -10, 0};
    model.planes = {{{0, 1, 0}, 0}};
    const auto state = run<float>(model, 120);
    EXPECT_NEAR(state.position[0].y(), model.parameters.collision_distance, 1e-6);
    EXPECT_NEAR(state.velocity[0].norm(), 0, 1e-3);
}

/// Sliding with Coulomb friction mu on the floor: the speed falls by mu g per second.
TEST(Physics, FrictionOnTheFloorIsCoulombs) {
    Model model = bare_model({{0, 0.05, 0}});
    model.velocity[0] = {3, 0, 0};
    model.parameters.gravity = {0, -10, 0};
    model.parameters.dynamic_friction = 0.2;
    model.parameters.iterations = 1;
    model.planes = {{{0, 1, 0}, 0}};
    const auto state = run<double>(model, 60);
    EXPECT_NEAR(state.velocity[0].x(), 3 - 0.2 * 10 * 1.0, 0.02);
}

/// A cluster that is moved and turned rigidly keeps its shape: shape matching does no work on a rigid motion.
TEST(Physics, AClusterInFreeFlightKeepsItsShape) {
    std::vector<Eigen::Vector3d> corners;
    for (const double x : {0.0, 0.3})
        for (const double y : {0.0, 0.3})
            for (const double z : {0.0, 0.3}) corners.emplace_back(x, y, z);
    Model model = bare_model(corners);
    Cluster cluster;
    cluster.stiffness = 1;
    cluster.centre = Eigen::Vector3d::Constant(0.15);
    for (int i = 0; i < 8; ++i) {
        cluster.particles.push_back(i);
        cluster.rest_offset.push_back(corners[i] - cluster.centre);
        model.velocity[i] = Eigen::Vector3d(1, 0, 0) + Eigen::Vector3d(0, 0, 2).cross(corners[i] - cluster.centre);
    }
    model.clusters = {cluster};
    const auto state = run<double>(model, 60);
    for (int i = 0; i < 8; ++i)
        for (int j = 0; j < i; ++j)
            EXPECT_NEAR((state.position[i] - state.position[j]).norm(), (corners[i] - corners[j]).norm(), 2e-3);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const auto& x : state.position) mean += x / 8;
    EXPECT_NEAR(mean.x(), 1.15, 1e-3);
}

/// A state that can't be advanced is reported with its first bad particle and left as it was.
TEST(Physics, AnOverflowIsReportedAndNotWritten) {
    Model model = bare_model({{0, 0, 0}, {1, 0, 0}});
    model.velocity[1] = {1e38, 0, 0};
    model.time_step = 1000;
    Solver<float> solver(model);
    State<float> state = initial_state<float>(model);
    const auto bad = solver.update(state, model.time_step, 1);
    ASSERT_TRUE(bad);
    EXPECT_EQ(bad->particle, 1);
    EXPECT_EQ(bad->stage, "predict");
    EXPECT_TRUE(state.position[1].allFinite());
    EXPECT_EQ(state.position[1].x(), 1.0f);
}

}  // namespace
}  // namespace natator
