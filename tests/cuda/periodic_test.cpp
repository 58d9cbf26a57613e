// Periodic tanks on the GPU: what they must keep, and that they are the CPU's. native/periodic_test.cpp says more about
// them.
#include <iostream>

#include "../native/bare_particles.h"
#include "../native/periodic_models.h"
#include "gpu_test.h"
#include "natator/error.h"
#include "natator/evaluate.h"
#include "natator/model.h"
#include "natator/solver.h"
#include "solver/gpu_solver.h"

namespace natator::test {
namespace {

class GpuPeriodic : public OnGpu<> {};

/// Ghosts through an end, through two, and through an end and a wall.
TEST_F(GpuPeriodic, CornersAreTheCpus) {
    for (const std::vector<int>& axes : {std::vector<int>{0}, {2}, {0, 2}}) {
        Model model = stirred_periodic_water(axes);
        for (const PeriodicAxis& axis : model.periodic)  // some on the very seam: they are there but once
            for (Eigen::Vector3d& x : model.position)
                if (std::abs(x[axis.axis] - axis.low) < 0.04) x[axis.axis] = axis.low;
        OnBoth both(model);
        auto& [cpu, gpu, on_cpu, on_gpu] = both;
        for (int k = 0; k < 10; ++k) {
            ASSERT_TRUE(both.update(substep, 1));
            EXPECT_EQ(gpu.neighbour_counts(), cpu.neighbour_counts()) << k;
        }
        std::cout << "measured: periodic water, ten substeps " << max_distance(on_cpu, on_gpu) << '\n';
        EXPECT_LE(max_distance(on_cpu, on_gpu), 1e-13);
        EXPECT_GT(max_distance(initial_state<double>(model), on_gpu), 1e-2);
    }
}

/// Pairs across the seam are equal and opposite, in floats too, whose gradients are packed.
template <class Real>
void expect_momentum_kept(const Model& model, double bound) {
    GpuSolver<Real> gpu(model);
    State<Real> state = initial_state<Real>(model);
    const Eigen::Vector3d before = momentum(model, state);
    advance_frames(gpu, model, state, 20);
    const Eigen::Vector3d change = momentum(model, state) - before;
    const double size = momentum_size(model, initial_state<Real>(model));
    std::cout << "measured: momentum gained in a periodic tank "
              << std::max(std::abs(change.x()), std::abs(change.z())) / size << '\n';
    EXPECT_LE(std::abs(change.x()), bound * size);
    EXPECT_LE(std::abs(change.z()), bound * size);
    EXPECT_GT(std::abs(change.y()), 1e-3 * size);  // the floor pushes
}

TEST_F(GpuPeriodic, MomentumIsKeptThroughTheEnds) {
    Model model = stirred_periodic_water({0, 2});
    model.parameters.gravity.setZero();
    expect_momentum_kept<float>(model, 1e-7);
    expect_momentum_kept<double>(model, 1e-15);
}

/// A body crosses the seam as on the CPU, also one that has gone round before; its forces too.
TEST_F(GpuPeriodic, ABodyGoesRoundAsOnTheCpu) {
    Model model = cube_through_periodic_water(0.95);
    for (const double laps : {0.0, -3.0}) {
        for (const int i : model.clusters.front().particles) model.position[i].x() += laps * model.periodic[0].length();
        OnBoth both(model, true);
        auto& [cpu, gpu, on_cpu, on_gpu] = both;
        for (int k = 0; k < 6; ++k) {
            advance_frames(cpu, model, on_cpu, 1);
            advance_frames(gpu, model, on_gpu, 1);
        }
        std::cout << "measured: a body through the seam " << max_distance(on_cpu, on_gpu) << '\n';
        EXPECT_LE(max_distance(on_cpu, on_gpu), 1e-13);
        const auto forces = gpu.forces(), expected = cpu.forces();
        double largest = 0;
        for (const int i : model.clusters.front().particles) {
            EXPECT_LE((forces[i] - expected[i]).norm(), 1e-6) << i;
            largest = std::max(largest, forces[i].norm());
        }
        EXPECT_GT(largest, 0.1);
    }
}

/// Forces of the water that the thesis leaves off reach through the ends.
TEST_F(GpuPeriodic, EffectsAreTheCpus) {
    Model model = stirred_periodic_water({0, 2});
    model.parameters.cohesion = 0.002;
    model.parameters.surface_tension = 5;
    model.parameters.vorticity_confinement = 0.5;
    OnBoth both(model);
    auto& [cpu, gpu, on_cpu, on_gpu] = both;
    for (int k = 0; k < 4; ++k) {
        ASSERT_TRUE(both.update(substep, 1));
    }
    EXPECT_LE(max_distance(on_cpu, on_gpu), 1e-11);
}

/// A swim through the end: the same bits alone and in a batch, and as far as on the CPU.
TEST_F(GpuPeriodic, ASwimIsTheCpus) {
    nlohmann::json overrides =
        nlohmann::json::parse(R"({"duration": 0.25, "stopping": {"noProgressAfter": 0}, "settling": {"updates": 10}})");
    const Scene scene = load_scene("open-water/periodic", overrides);
    std::vector<BatchMember> members;
    for (int k = 0; k < 3; ++k) members.push_back({wave(scene, k), {}});
    const BatchOptions in_double{.precision = Precision::double_precision};
    const std::vector<Evaluation> all = evaluate_on_gpu(scene, members, in_double);
    EXPECT_EQ(evaluate_on_gpu(scene, {members[1]}, in_double)[0].hash, all[1].hash);
    EXPECT_NE(all[0].hash, all[1].hash);
    const Evaluation on_cpu = evaluate(scene, members[0].gait, {.precision = Precision::double_precision});
    std::cout << "measured: a swim in a periodic tank " << std::abs(on_cpu.distance - all[0].distance) << '\n';
    EXPECT_NEAR(on_cpu.distance, all[0].distance, 1e-12);
}

TEST_F(GpuPeriodic, MoreBoundariesThanItHasRoomForAreRefused) {
    Model model = stirred_periodic_water({0, 2});
    model.planes.push_back({{0, -1, 0}, 2});
    GpuSolver<float> fits(model);  // six
    model.planes.push_back({{0, -1, 0}, 3});
    try {
        GpuSolver<float> refused(model);
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("7 planes and ends of periodic axes; must be at most 6"),
                  std::string::npos)
            << error.what();
    }
}

}  // namespace
}  // namespace natator::test
