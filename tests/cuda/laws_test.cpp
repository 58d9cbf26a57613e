// Laws that scheme conserving keeps, on the GPU: each against its closed form or its exact symmetry. The CPU's tests of
// the same laws, native/laws_test.cpp and its neighbours, say more about where the bounds come from.
#include "../native/energy.h"
#include "../native/fluid_column.h"
#include "evaluate/settle.h"
#include "gpu_test.h"
#include "natator/gpu_solver.h"
#include "natator/model_builder.h"
#include "natator/momentum.h"

namespace natator::test {
namespace {

class GpuLaws : public OnGpu<> {};

template <class Real>
void expect_momentum_kept(int creature, double bound) {
    const Scene scene = creature_scene(creature, Scheme::conserving, "-vacuum");
    const Model model = build_model(scene);
    Gait gait = wave(scene);
    gait.frequency = 2;
    GpuSolver<Real> solver(model);
    State<Real> state = initial_state<Real>(model);
    double linear = 0, angular = 0, linear_size = 0, angular_size = 0;
    for (int k = 0; k < 240; ++k) {
        ASSERT_FALSE(solver.frame(state, gait));
        const Momentum now = measure_momentum(model, state);
        linear = std::max(linear, now.linear);
        angular = std::max(angular, now.angular);
        linear_size = std::max(linear_size, now.linear_size);
        angular_size = std::max(angular_size, now.angular_size);
    }
    ASSERT_GT(linear_size, 1);
    EXPECT_LE(linear / linear_size, bound) << "linear";
    EXPECT_LE(angular / angular_size, bound) << "angular";
}

class GpuVacuum : public OnGpu<testing::TestWithParam<int>> {};
TEST_P(GpuVacuum, MomentumIsKeptInFloat) {
    expect_momentum_kept<float>(GetParam(), 1e-6);
}
TEST_P(GpuVacuum, MomentumIsKeptInDouble) {
    expect_momentum_kept<double>(GetParam(), 1e-12);
}
INSTANTIATE_TEST_SUITE_P(Creatures, GpuVacuum, testing::Values(1, 2, 3, 4));

TEST_F(GpuLaws, ADropWithUnequalMassesKeepsItsMomentum) {
    const Model model = drop_of_unequal_masses();
    GpuSolver<double> solver(model);
    State<double> state = initial_state<double>(model);
    const auto momentum = [&] {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (int i = 0; i < model.particles(); ++i) sum += state.velocity[i] / model.inverse_mass[i];
        return sum;
    };
    const Eigen::Vector3d before = momentum();
    for (int k = 0; k < 60; ++k) ASSERT_FALSE(solver.update(state, frame, 4));
    EXPECT_LE((momentum() - before).norm(), 1e-12 * measure_momentum(model, state).linear_size);
}

/// Hydrostatics: the column comes to rest at the height of its lattice, with the density of rest inside.
TEST_F(GpuLaws, AColumnStandsAtItsHeight) {
    const int width = 8, layers = 20;
    const Model model = fluid_column(width, layers, 16, 1);
    GpuSolver<float> solver(model);
    State<float> state = initial_state<float>(model);
    double largest_kinetic = 0;
    for (int k = 0; k < 240; ++k) {
        ASSERT_FALSE(solver.update(state, frame, model.parameters.substeps));
        largest_kinetic = std::max(largest_kinetic, kinetic_energy(model, state));
    }
    EXPECT_LT(kinetic_energy(model, state), largest_kinetic / 100);
    double mean_height = 0, density = 0;
    int inside = 0;
    const auto densities = solver.densities();
    const double side = model.planes[3].offset;
    for (int i = 0; i < model.particles(); ++i) {
        const auto& x = state.position[i];
        mean_height += double(x.y()) / model.particles();
        const auto from_wall = [side](float v) { return std::min(double(v), side - double(v)); };
        const bool counts = std::min(from_wall(x.x()), from_wall(x.z())) > model.parameters.radius && x.y() > 0.2f &&
                            double(x.y()) < 0.09 * (layers - 4);
        if (!counts) continue;
        density += double(densities[i]);
        ++inside;
    }
    EXPECT_NEAR(2 * mean_height, layers * 0.09, 0.02 * layers * 0.09);
    ASSERT_GT(inside, 100);
    EXPECT_NEAR(density / inside, 1, 0.01);
}

TEST_F(GpuLaws, ACollapsingBlockNeverGainsEnergy) {
    const Model model = collapsing_block();
    GpuSolver<float> solver(model);
    State<float> state = initial_state<float>(model);
    for (int k = 0; k < 100; ++k) {  // settling, as the thesis' scenes do
        ASSERT_FALSE(solver.update(state, 1e-4, 1));
        for (auto& v : state.velocity) v.setZero();
    }
    double last = total_energy(model, state);
    const double fall = last / 2;
    for (int k = 0; k < 180; ++k) {
        ASSERT_FALSE(solver.update(state, frame, model.parameters.substeps));
        const double now = total_energy(model, state);
        EXPECT_LE(now, last + 5e-3 * fall) << k;
        last = now;
    }
}

/// A chain that hangs from its held end: infinite mass, no fluid, no contacts; energy is only lost.
TEST_F(GpuLaws, AHangingChainNeverGainsEnergy) {
    const Model model = hanging_chain();
    GpuSolver<double> solver(model);
    State<double> state = initial_state<double>(model);
    double last = total_energy(model, state);
    const double fall = 10.0 * 11 * 0.6;
    for (int k = 0; k < 120; ++k) {
        ASSERT_FALSE(solver.update(state, frame, 16));
        const double now = total_energy(model, state);
        EXPECT_LE(now, last + 1e-3 * fall) << k;
        last = now;
    }
    EXPECT_EQ(state.position[0], Eigen::Vector3d(0, 2, 0));
}

TEST_F(GpuLaws, GalileanInvariance) {
    Scene scene = creature_scene(1, Scheme::conserving, "-vacuum");
    scene.solver.damping = 0;
    const Eigen::Vector3d drift(0.5, -0.25, 0.125);
    const auto swim = [&](const Eigen::Vector3d& velocity) {
        Model model = build_model(scene);
        for (auto& v : model.velocity) v = velocity;
        GpuSolver<double> solver(model);
        State<double> state = initial_state<double>(model);
        for (int k = 0; k < 30; ++k) EXPECT_FALSE(solver.frame(state, wave(scene)));
        return state;
    };
    const auto at_rest = swim(Eigen::Vector3d::Zero()), moving = swim(drift);
    for (std::size_t i = 0; i < at_rest.position.size(); ++i)
        EXPECT_LE((moving.position[i] - drift * 0.5 - at_rest.position[i]).norm(), 1e-9) << i;
}

/// Mean height of the thesis' swimmer with slack muscles after 1.5 s: buoyancy, at any number of substeps.
double floating_height(int substeps, int iterations) {
    Scene scene = creature_scene(1, Scheme::conserving);
    scene.solver.substeps = substeps;
    scene.solver.numIterations = iterations;
    const Model model = build_model(scene);
    Gait slack = wave(scene);
    slack.amplitude.assign(slack.amplitude.size(), 0);
    Solver<float> cpu(model);
    GpuSolver<float> solver(model);
    State<float> state = initial_state<float>(model);
    EXPECT_FALSE(settle(scene.settling, cpu, state));
    for (int k = 0; k < 90; ++k) EXPECT_FALSE(solver.frame(state, slack));
    double height = 0;
    for (const int i : model.body.particles)
        height += double(state.position[i].y()) / double(model.body.particles.size());
    return height;
}

TEST_F(GpuLaws, TheSwimmerFloatsAtOneDepthAtAnyNumberOfSubsteps) {
    const double height = floating_height(4, 4);
    EXPECT_LT(height, 0.5);
    EXPECT_GT(height, 0.1);
    EXPECT_NEAR(floating_height(8, 4), height, 0.005);
    EXPECT_NEAR(floating_height(16, 1), height, 0.005);
}

}  // namespace
}  // namespace natator::test
