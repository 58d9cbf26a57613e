// The same Model and State on the GPU and on the CPU.
#include <future>
#include <iostream>
#include <thread>

#include "gpu_test.h"
#include "natator/evaluate.h"
#include "natator/measure.h"
#include "natator/model.h"
#include "run/settle.h"
#include "solver/gpu_solver.h"

namespace natator::test {
namespace {

using Case = std::tuple<int, Scheme>;

std::string case_name(const testing::TestParamInfo<Case>& info) {
    return "Creature" + std::to_string(std::get<0>(info.param)) + name_of(std::get<1>(info.param));
}

const auto all_cases = testing::Combine(testing::Values(1, 2, 3, 4), testing::Values(Scheme::flex, Scheme::conserving));

class GpuAgreement : public OnGpu<testing::TestWithParam<Case>> {
protected:
    /// From the settled start on: all particles after one frame, the body's mean after 0.25 s.
    template <class Real>
    void expect_agreement(double frame_bound, double path_bound) {
        const auto [creature, scheme] = GetParam();
        const Scene scene = creature_scene(creature, scheme);
        const Model model = build_model(scene);
        const Gait gait = wave(scene);
        Solver<Real> cpu(model);
        GpuSolver<Real> gpu(model);
        State<Real> on_cpu = initial_state<Real>(model);
        ASSERT_FALSE(settle(scene.settling, cpu, on_cpu));
        State<Real> on_gpu = on_cpu;
        for (int frame = 1; frame <= 15; ++frame) {
            ASSERT_FALSE(cpu.frame(on_cpu, gait));
            ASSERT_FALSE(gpu.frame(on_gpu, gait));
            if (frame > 1) continue;
            const double apart = max_distance(on_cpu, on_gpu);
            std::cout << "measured: creature " << creature << ' ' << name_of(scheme) << ' ' << sizeof(Real) * 8
                      << " bits: after a frame " << apart;
            EXPECT_LE(apart, frame_bound);
            const auto cpu_density = cpu.densities(), gpu_density = gpu.densities();
            double density_apart = 0;
            for (std::size_t i = 0; i < cpu_density.size(); ++i)
                density_apart = std::max(density_apart, std::abs(double(cpu_density[i]) - double(gpu_density[i])));
            EXPECT_LE(density_apart, 100 * frame_bound);
        }
        EXPECT_NEAR(gpu.muscle_work(), cpu.muscle_work(), 0.01 * std::abs(cpu.muscle_work()));
        const double path = std::abs(mean_x(model.body, on_cpu) - mean_x(model.body, on_gpu));
        std::cout << ", mean x after 0.25 s " << path << ", particles " << max_distance(on_cpu, on_gpu) << '\n';
        EXPECT_LE(path, path_bound);
    }
};

TEST_P(GpuAgreement, Float) {
    expect_agreement<float>(2e-4, 2e-4);
}
/// Rounding is 5e8 times smaller than in float.
TEST_P(GpuAgreement, Double) {
    expect_agreement<double>(1e-12, 1e-8);
}
INSTANTIATE_TEST_SUITE_P(Creatures, GpuAgreement, all_cases, case_name);

struct MeanAndError {
    double mean = 0, error = 0;  ///< standard error of the mean
};

MeanAndError summary(const std::vector<double>& values) {
    const double n = static_cast<double>(values.size());
    double sum = 0, squares = 0;
    for (const double v : values) sum += v;
    for (const double v : values) squares += (v - sum / n) * (v - sum / n);
    return {sum / n, std::sqrt(squares / (n - 1) / n)};
}

/// Runs on as many processors as there are.
std::vector<double> distances_on_cpu(const Scene& scene, const std::vector<BatchMember>& members) {
    std::vector<double> distances(members.size());
    std::atomic<std::size_t> next = 0;
    std::vector<std::thread> workers;
    for (unsigned w = 0; w < std::max(1u, std::thread::hardware_concurrency()); ++w)
        workers.emplace_back([&] {
            for (std::size_t k = next++; k < members.size(); k = next++)
                distances[k] = evaluate(scene, members[k].gait, {.perturbation = members[k].perturbation}).distance;
        });
    for (std::thread& worker : workers) worker.join();
    return distances;
}

/// Trajectories are chaotic: over 4 s it is the means of ensembles that must agree. Three standard errors of their
/// difference, as eight pairs of them are looked at; the CPU's ensemble is the smaller one.
class GpuEnsemble : public OnGpu<testing::TestWithParam<Case>> {};
TEST_P(GpuEnsemble, MeanDistanceOverFourSecondsIsTheCpus) {
    const auto [creature, scheme] = GetParam();
    Scene scene = creature_scene(creature, scheme);
    scene.stopping = {};
    scene.stopping.plane_contact = false;
    scene.stopping.no_progress_after = 0;
    std::vector<BatchMember> members;
    for (int k = 0; k < 128; ++k) members.push_back({wave(scene), {1e-6, static_cast<std::uint64_t>(k + 1)}});
    std::vector<double> on_gpu;
    for (const Evaluation& evaluation : evaluate_on_gpu(scene, members)) {
        EXPECT_EQ(evaluation.stopped, StopReason::completed);
        on_gpu.push_back(evaluation.distance);
    }
    members.resize(16);
    const MeanAndError gpu = summary(on_gpu), cpu = summary(distances_on_cpu(scene, members));
    const double error = std::hypot(gpu.error, cpu.error);
    std::cout << "measured: creature " << creature << ' ' << name_of(scheme) << " GPU " << gpu.mean << " +- "
              << gpu.error << ", CPU " << cpu.mean << " +- " << cpu.error << ", apart " << (gpu.mean - cpu.mean) / error
              << " standard errors\n";
    EXPECT_LE(std::abs(gpu.mean - cpu.mean), 3 * error + 1e-6);
}
INSTANTIATE_TEST_SUITE_P(Creatures, GpuEnsemble, all_cases, case_name);

/// Undivided relaxation explodes: both backends must say so, at the same substep, stage and particle.
TEST(GpuInstability, IsNamedAsTheCpuNamesIt) {
    if (cuda_devices().empty()) GTEST_SKIP() << "no GPU here";
    Scene scene = creature_scene(1, Scheme::flex);
    scene.solver.flex.relaxationMode = RelaxationMode::global;
    scene.solver.relaxation_factor = 10;
    const Gait gait = wave(scene);
    const Evaluation cpu = evaluate(scene, gait);
    const std::vector<Evaluation> gpu = evaluate_on_gpu(scene, {{gait, {}}, {gait, {}}});
    ASSERT_EQ(cpu.stopped, StopReason::unstable);
    for (const Evaluation& one : gpu) {
        ASSERT_EQ(one.stopped, StopReason::unstable);
        ASSERT_TRUE(one.instability);
        EXPECT_EQ(one.instability->stage, cpu.instability->stage);
        EXPECT_EQ(one.instability->particle, cpu.instability->particle);
        EXPECT_NEAR(one.instability->time, cpu.instability->time, 1e-12);
        EXPECT_EQ(one.frames, cpu.frames);
        EXPECT_EQ(one.hash, gpu[0].hash);
    }
}

/// A scene that breaks a law, and the law.
struct BrokenCase {
    const char* overrides;
    const char* law;
};

class GpuBrokenLaws : public testing::TestWithParam<BrokenCase> {};

/// One by itself, a batch, and kernels of the whole GPU see it in the same frame as the CPU does.
TEST_P(GpuBrokenLaws, AreNamedAsTheCpuNamesThem) {
    if (cuda_devices().empty()) GTEST_SKIP() << "no GPU here";
    const Scene scene = load_scene("bench/small-tank", nlohmann::json::parse(GetParam().overrides));
    const Gait gait = wave(scene);
    const Evaluation cpu = evaluate(scene, gait);
    ASSERT_TRUE(cpu.instability);
    EXPECT_EQ(cpu.instability->law, GetParam().law);
    for (const bool whole : {false, true})
        for (const int members : {1, 3})
            for (const Evaluation& gpu :
                 evaluate_on_gpu(scene, std::vector<BatchMember>(members, {gait, {}}), {.whole_gpu = whole})) {
                ASSERT_EQ(gpu.stopped, StopReason::unstable);
                EXPECT_EQ(gpu.fitness(), 0);
                EXPECT_EQ(gpu.instability->law, cpu.instability->law);
                EXPECT_EQ(gpu.instability->stage, cpu.instability->stage);
                EXPECT_NEAR(gpu.instability->time, cpu.instability->time, 1e-12);
                EXPECT_EQ(gpu.frames, cpu.frames);
            }
}

INSTANTIATE_TEST_SUITE_P(
    Cases, GpuBrokenLaws,
    testing::Values(
        BrokenCase{R"({"fluid": {"mass": {"bottom": 0.005}}})", "tank"},
        BrokenCase{R"({"solver": {"collisionDistance": 1000}, "stopping": {"planeContact": false}})", "tank"},
        BrokenCase{R"({"scheme": "conserving", "solver": {"surfaceTension": 100}})", "energy"},
        BrokenCase{
            R"({"scheme": "conserving", "fluid": {"mass": {"gradient": "mass-linear", "bottom": 0.001, "top": 1000}}})",
            "particle-energy"}));

}  // namespace
}  // namespace natator::test
