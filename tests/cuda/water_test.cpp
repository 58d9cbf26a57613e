// Scheme conserving on the GPU: what its water must keep, and that it is the CPU's. native/dfsph_test.cpp says more about it.
#include <iostream>

#include "../native/bare_particles.h"
#include "gpu_test.h"
#include "model/disorder_fluid.h"
#include "natator/gpu_solver.h"
#include "natator/model_builder.h"
#include "natator/momentum.h"

namespace natator::test {
namespace {

class GpuWater : public OnGpu<> {};

constexpr double spacing = 0.09;

Model drop(const Points& positions) {
    Model model = bare_model(Scheme::conserving, positions, fluid_phase);
    disorder_fluid(spacing, model);
    model.parameters.kinematicViscosity = 0.01;
    return model;
}

/// A drop that turns while it falls together.
TEST_F(GpuWater, ADropKeepsItsMomentum) {
    const Model model = drop(lattice(9, 9, 9, spacing));
    State<double> state = initial_state<double>(model);
    for (int i = 0; i < model.particles(); ++i)
        state.velocity[i] = Eigen::Vector3d(0, 0, 2).cross(state.position[i]) - 0.5 * state.position[i];
    const auto momentum = [&] {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const auto& v : state.velocity) sum += v;
        return sum;
    };
    const Eigen::Vector3d before = momentum();
    GpuSolver<double> gpu(model);
    for (int k = 0; k < 120; ++k) ASSERT_FALSE(gpu.update(state, substep, 1));
    ASSERT_GT(measure_momentum(model, state).linear_size, 1);
    EXPECT_LE((momentum() - before).norm(), 1e-12 * measure_momentum(model, state).linear_size);
}

/// Water in a corner of three walls, one of them oblique to the axes, with another that it nearly touches: ghosts of
/// ghosts, in all orders.
TEST_F(GpuWater, CornersAndNarrowGapsAreTheCpus) {
    Model model = drop(lattice(12, 8, 2, spacing, Eigen::Vector3d(0.6, 0.4, 0.1)));
    model.parameters.gravity = {0, -10, 0};
    const Eigen::Vector3d x = Eigen::Vector3d(3, 4, 0) / 5, y = Eigen::Vector3d(-4, 3, 0) / 5;
    const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
    for (auto& at : model.position) at = (at.x() * x + at.y() * y + at.z() * z).eval();
    model.planes = {{x, 0}, {y, 0}, {z, 0}, {-z, 0.2}};
    Solver<double> cpu(model);
    GpuSolver<double> gpu(model);
    State<double> on_cpu = initial_state<double>(model), on_gpu = on_cpu;
    for (int k = 0; k < 10; ++k) {
        ASSERT_FALSE(cpu.update(on_cpu, substep, 1));
        ASSERT_FALSE(gpu.update(on_gpu, substep, 1));
        EXPECT_EQ(gpu.neighbour_counts(), cpu.neighbour_counts()) << k;
    }
    std::cout << "measured: corner, ten substeps " << largest_distance(on_cpu, on_gpu) << '\n';
    EXPECT_LE(largest_distance(on_cpu, on_gpu), 1e-11);
    EXPECT_LE(largest_distance(initial_state<double>(model), on_gpu), 1);
    EXPECT_GT(largest_distance(initial_state<double>(model), on_gpu), 1e-3);
}

/// More neighbours than lists have room for at first: the update is done again, with the same outcome as on the CPU.
TEST_F(GpuWater, ACrowdGetsRoomForItsNeighbours) {
    Points positions = lattice(12, 12, 12, 0.03);
    positions.resize(1500);
    const Model model = drop(positions);
    Solver<double> cpu(model);
    GpuSolver<double> gpu(model);
    State<double> on_cpu = initial_state<double>(model), on_gpu = on_cpu;
    ASSERT_FALSE(cpu.update(on_cpu, substep, 1));
    ASSERT_FALSE(gpu.update(on_gpu, substep, 1));
    const std::vector<int> counts = gpu.neighbour_counts();
    EXPECT_GT(*std::max_element(counts.begin(), counts.end()), 300);
    EXPECT_EQ(counts, cpu.neighbour_counts());
    for (int k = 0; k < 3; ++k) {
        ASSERT_FALSE(cpu.update(on_cpu, 2 * substep, 2));
        ASSERT_FALSE(gpu.update(on_gpu, 2 * substep, 2));
    }
    EXPECT_LE(largest_distance(on_cpu, on_gpu), 1e-9);
}

}  // namespace
}  // namespace natator::test
