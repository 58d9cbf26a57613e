// Bare particles on the GPU: starts that overlap in scheme conserving, and what the neighbour search must agree with.
#include <random>

#include "../native/bare_particles.h"
#include "../native/refusal_of.h"
#include "gpu_test.h"
#include "natator/measure.h"
#include "solver/gpu_solver.h"

namespace natator::test {
namespace {

class GpuParticles : public OnGpu<> {};

/// More neighbours than lists hold, densities far above rest: see native/overlap_test.cpp.
TEST_F(GpuParticles, ACompressedBlockExpandsSlowlyAndKeepsItsMomentum) {
    Points positions = lattice(9, 9, 9, 0.02);
    positions.resize(600);  // not symmetric
    const Model model = overlapping(positions, fluid_phase);
    GpuSolver<double> solver(model);
    State<double> state = initial_state<double>(model);
    double speed = 0;
    for (int k = 0; k < 240; ++k) {
        ASSERT_FALSE(solver.update(state, substep, 1));
        for (const auto& v : state.velocity) speed = std::max(speed, v.norm());
    }
    EXPECT_LT(speed, 2 * std::sqrt(2 * 100 * 0.1));
    EXPECT_GT(speed, 0.1);
    const Momentum now = measure_momentum(model, state);
    EXPECT_LE(now.linear, 1e-12 * now.linear_size);
    const std::vector<double> densities = solver.densities();
    EXPECT_LT(*std::max_element(densities.begin(), densities.end()), 1.2);
}

TEST_F(GpuParticles, ADeepContactIsPushedAtTheLimitedAcceleration) {
    const Model model = overlapping({{-0.025, 0, 0}, {0.025, 0, 0}}, solid_phase);
    GpuSolver<double> solver(model);
    State<double> state = initial_state<double>(model);
    for (int k = 0; k < 60; ++k) ASSERT_FALSE(solver.update(state, substep, 1));
    const double apart = state.velocity[1].x() - state.velocity[0].x();
    EXPECT_NEAR(apart, std::sqrt(2 * 100 * 0.1), 0.1 * std::sqrt(2 * 100 * 0.1));
    EXPECT_NEAR(state.velocity[1].x(), -state.velocity[0].x(), 1e-12);
}

TEST_F(GpuParticles, AParticleBehindAWallIsPutOnItWithoutVelocity) {
    Model model = overlapping({{0, -3, 0}, {1, 0.05, 0}}, solid_phase);
    model.planes = {{{0, 1, 0}, 0}};
    GpuSolver<double> solver(model);
    State<double> state = initial_state<double>(model);
    for (int k = 0; k < 10; ++k) ASSERT_FALSE(solver.update(state, substep, 1));
    EXPECT_NEAR(state.position[0].y(), model.parameters.collision_distance, 1e-12);
    EXPECT_NEAR(state.velocity[0].norm(), 0, 1e-12);
    EXPECT_EQ(state.position[1].y(), 0.05);
}

TEST_F(GpuParticles, WhatDoesNotFitTheModelIsRefusedAsOnTheCpu) {
    for (const Scheme scheme : {Scheme::flex, Scheme::conserving}) {
        Model model = bare_model(scheme, {{0, 0, 0}, {1, 0, 0}}, solid_phase);
        Solver<float> cpu(model);
        GpuSolver<float> gpu(model);
        State<float> state = initial_state<float>(model);
        const Gait gait = resting_gait(1);
        EXPECT_EQ(refusal_of([&] { gpu.frame(state, gait); }), refusal_of([&] { cpu.frame(state, gait); }));
        EXPECT_NE(refusal_of([&] { gpu.frame(state, gait); }), "");

        state.velocity.pop_back();
        EXPECT_EQ(refusal_of([&] { gpu.update(state, substep, 1); }),
                  refusal_of([&] { cpu.update(state, substep, 1); }));
        EXPECT_NE(refusal_of([&] { gpu.update(state, substep, 1); }), "");

        model.velocity.pop_back();
        EXPECT_EQ(refusal_of([&] { const GpuSolver<float> refused(model); }),
                  refusal_of([&] { const Solver<float> refused(model); }));
        EXPECT_NE(refusal_of([&] { const GpuSolver<float> refused(model); }), "");
    }
}

/// The neighbour search against all pairs, also for particles far outside the grid's box.
TEST_F(GpuParticles, NeighbourCountsEqualASearchOverAllPairs) {
    for (const Scheme scheme : {Scheme::flex, Scheme::conserving}) {
        Model model = bare_model(scheme, {}, fluid_phase);
        std::mt19937_64 random(7);
        std::uniform_real_distribution<double> place(0.05, 0.65);
        for (int i = 0; i < 500; ++i) {
            model.position.emplace_back(place(random), place(random), place(random));
            model.velocity.emplace_back(Eigen::Vector3d::Zero());
            model.inverse_mass.push_back(1);
            model.phase.push_back(i % 10 == 0 ? 1u : fluid_phase);
        }
        for (int i = 0; i < 20; ++i)
            model.position[i * 7] += Eigen::Vector3d(1e4 * (i % 3 - 1), 300.0 * i, -5e3 * (i % 2));
        OnBoth both(model);
        auto& [cpu, gpu, on_cpu, on_gpu] = both;
        ASSERT_TRUE(both.update(1e-9, 1));
        EXPECT_EQ(gpu.neighbour_counts(), cpu.neighbour_counts());
        const SolverParameters& p = model.parameters;
        for (int i = 0; i < model.particles(); ++i) {
            int expected = 0;
            for (int j = 0; j < model.particles(); ++j) {
                const double distance = (model.position[i] - model.position[j]).norm();
                if (i == j) continue;
                // Solids feel the fluid alone in flex; in the water of conserving all are neighbours of all.
                expected += scheme == Scheme::flex ? distance < p.radius && (model.is_fluid(i) || model.is_fluid(j))
                                                   : distance < p.conserving.kernel_support * p.fluid_rest_distance;
            }
            EXPECT_EQ(gpu.neighbour_counts()[i], expected) << i;
        }
    }
}

}  // namespace
}  // namespace natator::test
