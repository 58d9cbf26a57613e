// Scheme conserving on the GPU: what its water must keep, and that it is the CPU's. native/water_test.cpp says more
// about it.
#include <iostream>

#include "../native/bare_particles.h"
#include "../native/refusal_of.h"
#include "gpu_test.h"
#include "model/cluster.h"
#include "model/disorder_fluid.h"
#include "natator/evaluate.h"
#include "natator/measure.h"
#include "natator/model.h"
#include "solver/gpu_solver.h"

namespace natator::test {
namespace {

class GpuWater : public OnGpu<> {};

constexpr double spacing = 0.09;

Model drop(const Points& positions) {
    Model model = bare_model(Scheme::conserving, positions, fluid_phase);
    disorder_fluid(spacing, model);
    model.parameters.conserving.kinematic_viscosity = 0.01;
    return model;
}

TEST_F(GpuWater, HasNoTolerance) {
    Model model = drop(lattice(3, 3, 3, spacing));
    model.parameters.conserving.density_tolerance = 0.01;
    EXPECT_EQ(refusal_of([&] { const GpuSolver<float> refused(model); }),
              "backend cuda: densityTolerance = 0.01; must be 0: a GPU has numIterations");
}

/// A drop that turns while it falls together; with forces between its particles, too.
TEST_F(GpuWater, ADropKeepsItsMomentum) {
    Model model = drop(lattice(9, 9, 9, spacing));
    for (int i = 0; i < model.particles(); i += 3) model.inverse_mass[i] = 0.5;
    for (const bool forces : {false, true}) {
        model.parameters.cohesion = forces ? 0.002 : 0;
        model.parameters.surface_tension = forces ? 20 : 0;
        State<double> state = initial_state<double>(model);
        for (int i = 0; i < model.particles(); ++i)
            state.velocity[i] = Eigen::Vector3d(0, 0, 2).cross(state.position[i]) - 0.5 * state.position[i];
        const Eigen::Vector3d before = momentum(model, state);
        GpuSolver<double> gpu(model);
        for (int k = 0; k < 120; ++k) ASSERT_FALSE(gpu.update(state, substep, 1));
        ASSERT_GT(momentum_size(model, state), 1);
        EXPECT_LE((momentum(model, state) - before).norm(), 1e-12 * momentum_size(model, state)) << forces;
    }
}

/// Ghosts take part in the water's forces: what walls do is along their normals.
TEST_F(GpuWater, WallsPullAlongTheirNormalsOnly) {
    Model model = drop(lattice(6, 4, 5, spacing, {0, 2 * spacing, 0}));
    model.planes = {{{0, 1, 0}, 0}};
    model.parameters.cohesion = 0.002;
    model.parameters.surface_tension = 20;
    for (int i = 0; i < model.particles(); i += 3) model.inverse_mass[i] = 0.5;
    State<double> state = initial_state<double>(model);
    GpuSolver<double> gpu(model);
    for (int k = 0; k < 20; ++k) ASSERT_FALSE(gpu.update(state, substep, 1));
    const Eigen::Vector3d pull = momentum(model, state);
    const double size = momentum_size(model, state);
    EXPECT_GT(size, 1);
    EXPECT_LE(std::hypot(pull.x(), pull.z()), 1e-12 * size);
    EXPECT_GE(std::abs(pull.y()), 1e-6 * size);
}

/// Water in a corner of three walls, one of them oblique to the axes, with another that it nearly touches: ghosts of
/// ghosts, in all orders.
Model water_in_a_corner(int layers = 2) {
    Model model = drop(lattice(12, 8, layers, spacing, Eigen::Vector3d(0.6, 0.4, 0.05 * layers)));
    model.parameters.gravity = {0, -10, 0};
    const Eigen::Vector3d x = Eigen::Vector3d(3, 4, 0) / 5, y = Eigen::Vector3d(-4, 3, 0) / 5;
    const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
    for (auto& at : model.position) at = (at.x() * x + at.y() * y + at.z() * z).eval();
    model.planes = {{x, 0}, {y, 0}, {z, 0}, {-z, 0.1 * layers}};
    return model;
}

TEST_F(GpuWater, CornersAndNarrowGapsAreTheCpus) {
    const Model model = water_in_a_corner();
    OnBoth both(model);
    auto& [cpu, gpu, on_cpu, on_gpu] = both;
    for (int k = 0; k < 10; ++k) {
        ASSERT_TRUE(both.update(substep, 1));
        EXPECT_EQ(gpu.neighbour_counts(), cpu.neighbour_counts()) << k;
    }
    std::cout << "measured: corner, ten substeps " << max_distance(on_cpu, on_gpu) << '\n';
    EXPECT_LE(max_distance(on_cpu, on_gpu), 1e-11);
    EXPECT_LE(max_distance(initial_state<double>(model), on_gpu), 1);
    EXPECT_GT(max_distance(initial_state<double>(model), on_gpu), 1e-3);
}

/// More neighbours than lists have room for at first: the update is done again, with the same outcome as on the CPU.
TEST_F(GpuWater, ACrowdGetsRoomForItsNeighbours) {
    Points positions = lattice(12, 12, 12, 0.03);
    positions.resize(1500);
    const Model model = drop(positions);
    OnBoth both(model);
    auto& [cpu, gpu, on_cpu, on_gpu] = both;
    ASSERT_TRUE(both.update(substep, 1));
    const std::vector<int> counts = gpu.neighbour_counts();
    EXPECT_GT(*std::max_element(counts.begin(), counts.end()), 300);
    EXPECT_EQ(counts, cpu.neighbour_counts());
    for (int k = 0; k < 3; ++k) {
        ASSERT_TRUE(both.update(2 * substep, 2));
    }
    EXPECT_LE(max_distance(on_cpu, on_gpu), 1e-9);
}

/// More water in that corner with a body in its middle, rigid and free, and another in the corner that is held. The
/// water turns past both.
Model bodies_in_a_corner() {
    Model model = water_in_a_corner(6);
    model.parameters.conserving.kinematic_viscosity = 0.02;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& x : model.position) middle += x / model.particles();
    const Eigen::Vector3d held = model.position[0];
    std::vector<int> body;
    for (int i = 0; i < model.particles(); ++i) {
        model.velocity[i] = Eigen::Vector3d(0, 0, 3).cross(model.position[i] - middle);
        const bool is_free = (model.position[i] - middle).norm() < 1.7 * spacing;
        if (!is_free && (model.position[i] - held).norm() > 1.7 * spacing) continue;
        model.phase[i] = is_free ? 1 : 2;
        model.inverse_mass[i] = is_free ? 0.8 : 0;
        model.velocity[i].setZero();
        if (is_free) body.push_back(i);
    }
    model.clusters = {make_cluster(body, model.position, 1)};
    return model;
}

/// The sum of forces on particles of one phase.
Eigen::Vector3d sum_on(unsigned phase, const Model& model, const std::vector<Eigen::Vector3d>& forces) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int i = 0; i < model.particles(); ++i)
        if (model.phase[i] == phase) sum += forces[i];
    return sum;
}

/// The free body together gets what changes its momentum; where nobody asks there are no forces, and the same bits.
TEST_F(GpuWater, ForcesAreTheCpusAndWhatChangesABodysMomentum) {
    const Model model = bodies_in_a_corner();
    Execution execution;
    execution.forces = true;
    Solver<double> cpu(model, execution);
    GpuSolver<double> gpu(model, {.forces = true}), unasked(model);
    State<double> on_cpu = initial_state<double>(model), on_gpu = on_cpu, other = on_cpu;
    const auto body_momentum = [&] {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const int i : model.clusters[0].particles) sum += on_gpu.velocity[i] / model.inverse_mass[i];
        return sum;
    };
    const Eigen::Vector3d weight =
        model.parameters.gravity * static_cast<double>(model.clusters[0].particles.size()) / 0.8;
    EXPECT_TRUE(gpu.forces().empty());
    EXPECT_TRUE(gpu.pressures().empty());
    double largest = 0;
    for (int k = 0; k < 5; ++k) {
        const Eigen::Vector3d before = body_momentum();
        ASSERT_FALSE(cpu.update(on_cpu, 2 * substep, 2));
        ASSERT_FALSE(gpu.update(on_gpu, 2 * substep, 2));
        ASSERT_FALSE(unasked.update(other, 2 * substep, 2));
        const auto forces = gpu.forces(), expected = cpu.forces();
        ASSERT_EQ(forces.size(), expected.size());
        for (int i = 0; i < model.particles(); ++i) {
            if (model.is_fluid(i)) {
                ASSERT_EQ(forces[i].norm(), 0) << i;
            }
            largest = std::max(largest, (forces[i] - expected[i]).norm());
        }
        EXPECT_GT(sum_on(2, model, forces).norm(), 1e-3 * weight.norm());
        const Eigen::Vector3d change = (body_momentum() - before) / (2 * substep);
        EXPECT_LE((change - weight - sum_on(1, model, forces)).norm(), 1e-9 * weight.norm()) << k;
        const auto pressures = gpu.pressures(), its = cpu.pressures();
        ASSERT_EQ(pressures.size(), its.size());
        for (std::size_t i = 0; i < pressures.size(); ++i)
            EXPECT_NEAR(pressures[i], its[i], 1e-8 * weight.norm() / std::pow(spacing, 2)) << i;
    }
    std::cout << "measured: forces on bodies in a corner " << largest / weight.norm() << " of the weight\n";
    EXPECT_LE(largest, 1e-8 * weight.norm());
    EXPECT_TRUE(unasked.forces().empty());
    EXPECT_EQ(max_distance(on_gpu, other), 0);
    for (int i = 0; i < model.particles(); ++i) EXPECT_EQ(on_gpu.velocity[i], other.velocity[i]) << i;
}

/// What carries the water's weight does the same to water, bodies and walls on both.
TEST_F(GpuWater, ModifiedPressureIsTheCpus) {
    Model model = bodies_in_a_corner();
    model.position = lattice(12, 8, 6, spacing, Eigen::Vector3d(0.54, 0.36, 0.27));
    disorder_fluid(spacing, model);
    model.clusters[0] = make_cluster(model.clusters[0].particles, model.position, 1);
    model.planes = {
        {{0, 1, 0}, 0}, {{1, 0, 0}, 0}, {{-1, 0, 0}, 12 * spacing}, {{0, 0, 1}, 0}, {{0, 0, -1}, 6 * spacing}};
    model.parameters.conserving.modified_pressure = true;
    model.parameters.iterations = 1;  // so few, in so long a step, that most of the weight is carried
    model.time_step = 4 * substep;
    OnBoth both(model, true);
    auto& [cpu, gpu, on_cpu, on_gpu] = both;
    for (int k = 0; k < 5; ++k) ASSERT_TRUE(both.update(2 * substep, 2));
    std::cout << "measured: modified pressure, ten substeps " << max_distance(on_cpu, on_gpu) << '\n';
    EXPECT_LE(max_distance(on_cpu, on_gpu), 1e-11);
    const auto forces = gpu.forces(), expected = cpu.forces();
    const auto pressures = gpu.pressures(), its = cpu.pressures();
    const double largest = *std::max_element(its.begin(), its.end());
    EXPECT_GT(largest, 0);
    for (int i = 0; i < model.particles(); ++i) {
        EXPECT_LE((forces[i] - expected[i]).norm(), 1e-8 * largest * spacing * spacing) << i;
        EXPECT_NEAR(pressures[i], its[i], 1e-8 * largest) << i;
    }
    model.parameters.conserving.modified_pressure = false;
    State<double> whole = initial_state<double>(model);
    GpuSolver<double> other(model);
    for (int k = 0; k < 5; ++k) ASSERT_FALSE(other.update(whole, 2 * substep, 2));
    EXPECT_GT(max_distance(whole, on_gpu), 1e-5);
}

/// A viscosity that an explicit step does not bear is limited by what the two of a pair yield, held ones as water of
/// the mean mass does: where the water is of two masses that is neither's own.
TEST_F(GpuWater, LimitedViscosityBesideHeldBodiesIsTheCpus) {
    Model model = bodies_in_a_corner();
    model.parameters.conserving.kinematic_viscosity = 0.3 * spacing * spacing / substep;
    for (int i = 0; i < model.particles(); i += 2)
        if (model.is_fluid(i)) model.inverse_mass[i] /= 4;
    OnBoth both(model, true);
    auto& [cpu, gpu, on_cpu, on_gpu] = both;
    ASSERT_TRUE(both.update(substep, 1));
    const auto forces = gpu.forces(), expected = cpu.forces();
    double apart = 0, fastest = 0, off = 0, largest = 0;
    for (int i = 0; i < model.particles(); ++i) {
        apart = std::max(apart, (on_gpu.velocity[i] - on_cpu.velocity[i]).norm());
        fastest = std::max(fastest, on_cpu.velocity[i].norm());
        off = std::max(off, (forces[i] - expected[i]).norm());
        largest = std::max(largest, expected[i].norm());
    }
    std::cout << "measured: limited viscosity beside held bodies: velocities " << apart / fastest << ", forces "
              << off / largest << '\n';
    EXPECT_LE(apart, 1e-9 * fastest);
    EXPECT_LE(off, 1e-8 * largest);
    EXPECT_GT(largest, 0);
}

/// More neighbours than lists have room for: the update is done again, and its forces are of that alone.
TEST_F(GpuWater, ForcesAreSummedAnewWhereAnUpdateIsDoneAgain) {
    Points positions = lattice(12, 12, 12, 0.03);
    positions.resize(1500);
    Model model = drop(positions);
    for (int i = 700; i < 720; ++i) {
        model.phase[i] = 1;
        model.inverse_mass[i] = 0;
    }
    OnBoth both(model, true);
    auto& [cpu, gpu, on_cpu, on_gpu] = both;
    ASSERT_TRUE(both.update(substep, 1));
    const auto forces = gpu.forces(), expected = cpu.forces();
    for (int i = 700; i < 720; ++i) EXPECT_LE((forces[i] - expected[i]).norm(), 1e-7 * expected[i].norm()) << i;
    EXPECT_GT(sum_on(1, model, forces).norm(), 0);
}

struct WaterEffect {
    const char* name;
    double SolverParameters::* strength;
    double value;
};
const WaterEffect water_effects[] = {{"Cohesion", &SolverParameters::cohesion, 0.002},
                                     {"SurfaceTension", &SolverParameters::surface_tension, 5},
                                     {"Vorticity", &SolverParameters::vorticity_confinement, 0.5},
                                     {"FreeSurfaceDrag", &SolverParameters::free_surface_drag, 2}};

class GpuWaterEffects : public OnGpu<testing::TestWithParam<WaterEffect>> {};

/// A frame of water that turns in the corner, of unequal masses, one of them held.
TEST_P(GpuWaterEffects, InACornerAreTheCpus) {
    Model model = water_in_a_corner();
    for (int i = 0; i < model.particles(); ++i) {
        const Eigen::Vector3d arm = model.position[i] - model.position[model.particles() / 2];
        model.velocity[i] = Eigen::Vector3d(0, 0, 3).cross(arm);
        if (i % 3 == 0) model.inverse_mass[i] = 0.5;
    }
    model.inverse_mass[100] = 0;
    model.velocity[100].setZero();
    const auto after_a_frame = [&](auto&& solver) {
        State<double> state = initial_state<double>(model);
        EXPECT_FALSE(solver.update(state, 4 * substep, 4));
        return state;
    };
    const State<double> without = after_a_frame(Solver<double>(model));
    model.parameters.*GetParam().strength = GetParam().value;
    const State<double> on_cpu = after_a_frame(Solver<double>(model));
    const State<double> on_gpu = after_a_frame(GpuSolver<double>(model));
    std::cout << "measured: " << GetParam().name << " in a corner " << max_distance(on_cpu, on_gpu) << '\n';
    EXPECT_GT(max_distance(on_cpu, without), 1e-4);
    EXPECT_LE(max_distance(on_cpu, on_gpu), 1e-12);
    for (int i = 0; i < model.particles(); ++i) EXPECT_LE((on_cpu.velocity[i] - on_gpu.velocity[i]).norm(), 1e-9) << i;
}
INSTANTIATE_TEST_SUITE_P(All, GpuWaterEffects, testing::ValuesIn(water_effects),
                         [](const auto& test) { return std::string(test.param.name); });

/// All of them: a member of a batch is as it is alone, and as on the CPU.
TEST_F(GpuWater, EffectsAreTheSameInABatch) {
    Scene scene = creature_scene(1, Scheme::conserving);
    for (const WaterEffect& effect : water_effects) scene.solver.*effect.strength = effect.value;
    scene.duration = 0.1;
    std::vector<BatchMember> members;
    for (int k = 0; k < 5; ++k) members.push_back({wave(scene, k), {k == 2 ? 1e-6 : 0, 1}});
    const BatchOptions in_double{.precision = Precision::double_precision};
    const std::vector<Evaluation> all = evaluate_on_gpu(scene, members, in_double);
    for (std::size_t k = 0; k < members.size(); ++k) {
        EXPECT_EQ(all[k].stopped, StopReason::completed) << k;
        EXPECT_EQ(evaluate_on_gpu(scene, {members[k]}, in_double)[0].hash, all[k].hash) << k << " alone";
    }
    EXPECT_NE(all[0].hash, all[1].hash);
    const Evaluation on_cpu = evaluate(scene, members[0].gait, {.precision = Precision::double_precision});
    std::cout << "measured: batch with effects " << std::abs(on_cpu.distance - all[0].distance) << '\n';
    EXPECT_NEAR(on_cpu.distance, all[0].distance, 1e-8);
}

}  // namespace
}  // namespace natator::test
