// A State computed by the whole GPU: against the CPU, and against itself.
#include <cmath>
#include <iostream>
#include <string>

#include "../native/bare_particles.h"
#include "gpu_test.h"
#include "natator/evaluate.h"
#include "natator/measure.h"
#include "natator/model.h"
#include "run/cuda/uses_grid_kernels.h"
#include "run/settle.h"
#include "solver/cuda/grid/fetch_roof.h"
#include "solver/gpu_solver.h"

namespace natator::test {
namespace {

/// The thesis' tank, `scale` times as long, high and deep.
Scene tank(int scale, Scheme scheme) {
    return tank_of({scale * 50, scale * 7, scale * 17}, scheme);
}

/// One substep and one frame from a settled start.
template <class Real>
void expect_agreement(const Scene& scene, double substep_bound, double frame_bound) {
    const Model model = build_model(scene);
    const Gait gait = wave(scene);
    Solver<Real> cpu(model, {.threads = 2});
    GpuSolver<Real> gpu(model, {.path = GpuPath::whole_gpu});
    State<Real> on_cpu = initial_state<Real>(model);
    ASSERT_FALSE(settle(scene.settling, cpu, on_cpu));
    State<Real> on_gpu = on_cpu;
    const double substep = scene.time_step / scene.solver.substeps;
    State<Real> cpu_substep = on_cpu, gpu_substep = on_gpu;
    ASSERT_FALSE(cpu.update(cpu_substep, substep, 1));
    ASSERT_FALSE(gpu.update(gpu_substep, substep, 1));
    std::cout << "measured: after a substep " << max_distance(cpu_substep, gpu_substep);
    EXPECT_LE(max_distance(cpu_substep, gpu_substep), substep_bound);
    EXPECT_EQ(gpu.neighbour_counts(), cpu.neighbour_counts());
    ASSERT_FALSE(cpu.frame(on_cpu, gait));
    ASSERT_FALSE(gpu.frame(on_gpu, gait));
    std::cout << ", after a frame " << max_distance(on_cpu, on_gpu) << '\n';
    EXPECT_LE(max_distance(on_cpu, on_gpu), frame_bound);
    const auto cpu_density = cpu.densities(), gpu_density = gpu.densities();
    double density_apart = 0;
    for (std::size_t i = 0; i < cpu_density.size(); ++i)
        density_apart = std::max(density_apart, std::abs(double(cpu_density[i]) - double(gpu_density[i])));
    EXPECT_LE(density_apart, 100 * frame_bound);
}

class WholeGpu : public OnGpu<testing::TestWithParam<Scheme>> {};

TEST_P(WholeGpu, TheThesisTankAgreesWithTheCpu) {
    expect_agreement<float>(tank(1, GetParam()), 1e-5, 2e-4);
}
TEST_P(WholeGpu, TheThesisTankAgreesWithTheCpuInDouble) {
    expect_agreement<double>(tank(1, GetParam()), 1e-14, 1e-12);
}
TEST_P(WholeGpu, EightTimesTheFluidAgreesWithTheCpu) {
    expect_agreement<float>(tank(2, GetParam()), 1e-5, 2e-4);
}
TEST_P(WholeGpu, SixtyFourTimesTheFluidAgreesWithTheCpu) {
    expect_agreement<float>(tank(4, GetParam()), 1e-5,
                            GetParam() == Scheme::flex ? 2e-4 : 1e-2);  // as rounding grows by in a frame
}

/// A member's bits depend on nothing but itself, whatever was computed before it.
TEST_P(WholeGpu, EveryRunGivesTheSameBits) {
    Scene scene = tank(2, GetParam());
    scene.duration = 0.1;
    const std::vector<BatchMember> members{
        {wave(scene, 0), {}}, {wave(scene, 1), {1e-6, 1}}, {wave(scene, 0), {}}, {wave(scene, 2), {}}};
    const std::vector<Evaluation> first = evaluate_on_gpu(scene, members), second = evaluate_on_gpu(scene, members);
    for (std::size_t k = 0; k < members.size(); ++k) EXPECT_EQ(first[k].hash, second[k].hash) << k;
    EXPECT_EQ(first[0].hash, first[2].hash);
    EXPECT_NE(first[0].hash, first[1].hash);
    EXPECT_NE(first[0].hash, first[3].hash);
    EXPECT_EQ(first[0].frames, 6);
    EXPECT_EQ(first[3].hash, evaluate_on_gpu(scene, {members[3]})[0].hash) << "alone";
}

/// Where lists of contacts overflow they are searched anew: the same contacts in the same order.
TEST_P(WholeGpu, ContactsWithoutListsAreTheSame) {
    const Scene scene = tank(1, GetParam());
    const Model model = build_model(scene);
    State<double> with = initial_state<double>(model), without = with;
    GpuSolver<double> lists(model, {.path = GpuPath::whole_gpu}), search(model, {.path = GpuPath::whole_gpu_search});
    for (int frame = 0; frame < 5; ++frame) {
        ASSERT_FALSE(lists.frame(with, wave(scene)));
        ASSERT_FALSE(search.frame(without, wave(scene)));
    }
    EXPECT_LE(max_distance(with, without), 1e-12);
    EXPECT_EQ(lists.neighbour_counts(), search.neighbour_counts());
}

/// The same of the neighbours of water, which are then searched in every sum: the same numbers in the same order.
template <class Real>
void expect_the_same_without_lists(const Model& model) {
    State<Real> with = initial_state<Real>(model), without = with;
    GpuSolver<Real> lists(model, {.path = GpuPath::whole_gpu, .forces = true}),
        search(model, {.path = GpuPath::whole_gpu_search, .forces = true});
    for (int k = 0; k < 12; ++k) {
        ASSERT_FALSE(lists.update(with, substep, 1));
        ASSERT_FALSE(search.update(without, substep, 1));
    }
    EXPECT_EQ(with.position, without.position);
    EXPECT_EQ(with.velocity, without.velocity);
    EXPECT_EQ(lists.densities(), search.densities());
    EXPECT_EQ(lists.pressures(), search.pressures());
    EXPECT_EQ(lists.forces(), search.forces());
    EXPECT_EQ(lists.neighbour_counts(), search.neighbour_counts());
    EXPECT_GT(max_distance(initial_state<Real>(model), with), 1e-3);
}

class WithoutLists : public OnGpu<> {};

TEST_F(WithoutLists, TheThesisTankHasTheSameBits) {
    const Model model = build_model(tank(1, Scheme::conserving));
    expect_the_same_without_lists<float>(model);
    expect_the_same_without_lists<double>(model);
}

TEST_F(WithoutLists, WaterWithAllEffectsHasTheSameBits) {
    Model model = build_model(tank(1, Scheme::conserving));
    model.parameters.conserving.kinematic_viscosity = 0.002;
    model.parameters.cohesion = 0.002;
    model.parameters.surface_tension = 5;
    model.parameters.vorticity_confinement = 0.5;
    model.parameters.free_surface_drag = 0.5;
    expect_the_same_without_lists<float>(model);
}

/// A crowd, whose overlaps are parted, in so many slots that few threads share one where there are lists.
TEST_F(WithoutLists, ACrowdHasTheSameBits) {
    const Model model = bare_model(Scheme::conserving, lattice(48, 40, 30, 0.05), fluid_phase);
    expect_the_same_without_lists<float>(model);
}

TEST_F(WithoutLists, BatchesHaveTheSameBits) {
    Scene scene = tank(1, Scheme::conserving);
    scene.duration = 0.1;
    std::vector<BatchMember> members;
    for (int k = 0; k < 5; ++k) members.push_back({wave(scene, k), {}});
    const std::vector<Evaluation> with = evaluate_on_gpu(scene, members),
                                  without = evaluate_on_gpu(scene, members, {.without_lists = true});
    for (std::size_t k = 0; k < members.size(); ++k) EXPECT_EQ(with[k].hash, without[k].hash) << k;
}

/// More neighbours than a list holds, in cells that hold many particles: pairs that both sides keep, so momentum is
/// kept, and 96 at most.
TEST_P(WholeGpu, FullListsHoldTheirMostAndKeepMomentum) {
    Points positions = lattice(12, 12, 12, 0.02);
    positions.resize(1500);  // not symmetric
    Model model = bare_model(GetParam(), positions, fluid_phase);
    model.parameters.max_acceleration = 100;
    GpuSolver<double> gpu(model, {.path = GpuPath::whole_gpu});
    State<double> state = initial_state<double>(model);
    ASSERT_FALSE(gpu.update(state, substep, 1));
    const std::vector<int> counts = gpu.neighbour_counts();
    const int largest = *std::max_element(counts.begin(), counts.end());
    std::cout << "most neighbours " << largest << '\n';
    EXPECT_GT(largest, 80);
    if (GetParam() == Scheme::flex) {
        EXPECT_EQ(largest, model.parameters.flex.maxNeighborsPerParticle);
        return;
    }
    for (int k = 0; k < 20; ++k) ASSERT_FALSE(gpu.update(state, substep, 1));
    const Momentum now = measure_momentum(model, state);
    EXPECT_GT(now.linear_size, 0);
    EXPECT_LE(now.linear, 1e-12 * now.linear_size);
}

/// A wide, flat block: more particles in a layer of cells than 16 bits number.
TEST_P(WholeGpu, AFlatBlockAgreesWithTheCpu) {
    Points positions = lattice(220, 160, 3, 0.09);
    Model model = bare_model(GetParam(), positions, fluid_phase);
    Solver<float> cpu(model, {.threads = 2});
    GpuSolver<float> gpu(model, {.path = GpuPath::whole_gpu});
    State<float> on_cpu = initial_state<float>(model), on_gpu = on_cpu;
    ASSERT_FALSE(cpu.update(on_cpu, substep, 1));
    ASSERT_FALSE(gpu.update(on_gpu, substep, 1));
    EXPECT_EQ(gpu.neighbour_counts(), cpu.neighbour_counts());
    EXPECT_LE(max_distance(on_cpu, on_gpu), 1e-5);
}

/// CUDA copies no rows that are further apart than that.
TEST_P(WholeGpu, AStateMayTakeMoreThanTwoGibibytes) {
    constexpr int across = 220;
    const Model model = bare_model(GetParam(), lattice(across, across, across, 0.1), fluid_phase);
    GpuSolver<float> gpu(model, {.path = GpuPath::whole_gpu});
    State<float> state = initial_state<float>(model);
    ASSERT_FALSE(gpu.update(state, substep, 1));
    const int middle = (across / 2 * across + across / 2) * across + across / 2;
    EXPECT_EQ(gpu.neighbour_counts()[middle], GetParam() == Scheme::flex ? 18 : 80);
}

/// Scenes that batches compute by blocks, or by the whole GPU where that is asked for.
class EitherWay : public OnGpu<testing::TestWithParam<const char*>> {
protected:
    Scene scene() const {
        Scene scene = tank_of({80, 11, 27}, Scheme::flex);
        const nlohmann::json changes = nlohmann::json::parse(GetParam());
        for (const auto& [key, value] : changes.items()) number(scene.solver, key) = value.get<double>();
        scene.duration = 0.15;
        scene.stopping.no_progress_after = 0.1;
        return scene;
    }
    static double& number(SolverParameters& p, const std::string& key) {
        if (key == "solidPressure") return p.flex.solidPressure;
        if (key == "viscosity") return p.flex.viscosity;
        return key == "cohesion" ? p.cohesion : key == "damping" ? p.damping : p.max_acceleration;
    }
};

TEST_P(EitherWay, GivesTheSameBits) {
    const Scene scene = this->scene();
    std::vector<BatchMember> members;
    for (int k = 0; k < 6; ++k) members.push_back({wave(scene, 10 * k), {k % 2 * 1e-6, 1}});
    members[1].gait.power = 2.5;
    members[2].gait.offset.assign(members[2].gait.amplitude.size(), 0.1);
    const Model model = build_model(scene);
    ASSERT_FALSE(cuda::uses_grid_kernels(scene, model, {}));
    ASSERT_TRUE(cuda::uses_grid_kernels(scene, model, {.whole_gpu = true}));
    ASSERT_TRUE(cuda::uses_grid_kernels(scene, model, {.precision = Precision::double_precision}));
    Scene with_effect = scene;
    with_effect.solver.surface_tension = 0.5;
    ASSERT_TRUE(cuda::uses_grid_kernels(with_effect, build_model(with_effect), {}));
    const std::vector<Evaluation> blocks = evaluate_on_gpu(scene, members),
                                  whole = evaluate_on_gpu(scene, members, {.whole_gpu = true});
    for (std::size_t k = 0; k < members.size(); ++k) {
        EXPECT_EQ(blocks[k].hash, whole[k].hash) << k;
        EXPECT_EQ(blocks[k].distance, whole[k].distance) << k;
        EXPECT_EQ(blocks[k].frames, whole[k].frames) << k;
        EXPECT_EQ(blocks[k].stopped, whole[k].stopped) << k;
        EXPECT_EQ(blocks[k].errors.density_error_mean, whole[k].errors.density_error_mean) << k;
        EXPECT_FALSE(blocks[k].swimming || whole[k].swimming) << k;
        ASSERT_TRUE(blocks[k].course && whole[k].course) << k;
        EXPECT_EQ(blocks[k].course->forward, whole[k].course->forward) << k;
    }
    EXPECT_NE(blocks[0].hash, blocks[4].hash);
    EXPECT_EQ(evaluate_on_gpu(scene, {members[0]})[0].hash, whole[0].hash) << "by more blocks";
}

INSTANTIATE_TEST_SUITE_P(Scenes, EitherWay,
                         testing::Values("{}", R"({"cohesion": 0.01})", R"({"solidPressure": 0.5})",
                                         R"({"viscosity": 0, "maxAcceleration": 50, "damping": 0})"),
                         [](const auto& test) { return "Case" + std::to_string(test.index); });

TEST(GpuRoof, FetchesThePairsOfAllStates) {
    if (cuda_devices().empty()) GTEST_SKIP() << "no GPU here";
    Scene scene = tank(1, Scheme::conserving);
    const Gait gait = wave(scene);
    const cuda::FetchRoof one = cuda::measure_fetch_roof(scene, {gait}, 1, 0);
    const cuda::FetchRoof two = cuda::measure_fetch_roof(scene, {gait, gait}, 1, 0);
    EXPECT_GT(one.pairs, 30.0 * build_model(scene).particles());
    EXPECT_EQ(two.pairs, 2 * one.pairs);
    for (const double seconds : {one.velocities, one.impulses, one.density_constraint}) {
        EXPECT_GT(seconds, 0);
        EXPECT_TRUE(std::isfinite(seconds));
    }
}

/// Undivided relaxation explodes: the particle and the substep are the CPU's, the State is that before it.
TEST(WholeGpuInstability, IsNamedAsTheCpuNamesIt) {
    if (cuda_devices().empty()) GTEST_SKIP() << "no GPU here";
    Scene scene = tank(2, Scheme::flex);
    scene.solver.flex.relaxationMode = RelaxationMode::global;
    scene.solver.relaxation_factor = 10;
    scene.duration = 0.1;
    const Evaluation cpu = evaluate(scene, wave(scene));
    ASSERT_EQ(cpu.stopped, StopReason::unstable);
    for (const Evaluation& gpu : evaluate_on_gpu(scene, {{wave(scene), {}}, {wave(scene), {}}})) {
        ASSERT_EQ(gpu.stopped, StopReason::unstable);
        ASSERT_TRUE(gpu.instability);
        EXPECT_EQ(gpu.instability->stage, cpu.instability->stage);
        EXPECT_EQ(gpu.instability->particle, cpu.instability->particle);
        EXPECT_NEAR(gpu.instability->time, cpu.instability->time, 1e-12);
        EXPECT_EQ(gpu.frames, cpu.frames);
    }
}

INSTANTIATE_TEST_SUITE_P(Schemes, WholeGpu, testing::Values(Scheme::flex, Scheme::conserving),
                         [](const auto& test) { return name_of(test.param); });

}  // namespace
}  // namespace natator::test
