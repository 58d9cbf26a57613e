// A swimmer's numbers and its muscles' work on the GPU: the CPU's, in double.
#include <iostream>
#include <nlohmann/json.hpp>

#include "gpu_test.h"
#include "natator/evaluate.h"

namespace natator::test {
namespace {

struct Swim {
    const char* scene;
    Scheme scheme;
    bool whole_gpu;
    bool in_water;
};

class GpuSwimming : public OnGpu<testing::TestWithParam<Swim>> {};

/// Beats of little more than eight frames, so that there is one in little time.
TEST_P(GpuSwimming, NumbersAndWorkAreTheCpus) {
    const Swim& swim = GetParam();
    Scene scene = load_scene(swim.scene, {{"duration", 0.15},
                                          {"solver", {{"substeps", 4}, {"solidIterations", 3}, {"kinematicViscosity", 0.01}}},
                                          {"settling", {{"updates", 3}}}});
    scene.scheme = swim.scheme;
    Gait gait = wave(scene);
    gait.frequency = 7.4;
    const BatchMember member{gait, {1e-4, 3}};
    const Evaluation cpu =
        evaluate(scene, gait, {.precision = Precision::double_precision, .perturbation = member.perturbation});
    const std::vector<Evaluation> both = evaluate_on_gpu(
        scene, {member, {wave(scene), {}}},
        {.precision = Precision::double_precision, .whole_gpu = swim.whole_gpu});
    const Evaluation& gpu = both.front();
    std::cout << "measured: distances " << cpu.distance << " and " << gpu.distance - cpu.distance << " from it\n";
    constexpr double bound = 1e-6;
    EXPECT_NEAR(gpu.distance, cpu.distance, 0.1 * bound);
    ASSERT_EQ(cpu.work.has_value(), swim.scheme != Scheme::flex);
    ASSERT_EQ(gpu.work.has_value(), cpu.work.has_value());
    if (cpu.work) {
        EXPECT_GT(*cpu.work, 0);
        EXPECT_NEAR(*gpu.work / *cpu.work, 1, bound);
        EXPECT_NE(*both.back().work, *gpu.work);
    }
    ASSERT_EQ(cpu.swimming.has_value(), swim.in_water);
    ASSERT_EQ(gpu.swimming.has_value(), cpu.swimming.has_value());
    if (!cpu.swimming) return;
    EXPECT_GT(cpu.swimming->tail_amplitude, 1e-3);
    EXPECT_NEAR(gpu.swimming->tail_amplitude / cpu.swimming->tail_amplitude, 1, bound);
    EXPECT_NEAR(*gpu.swimming->reynolds / *cpu.swimming->reynolds, 1, 100 * bound);
    EXPECT_NEAR(*gpu.swimming->strouhal / *cpu.swimming->strouhal, 1, 100 * bound);
    EXPECT_NEAR(*gpu.swimming->swimming_number / *cpu.swimming->swimming_number, 1, bound);
}

INSTANTIATE_TEST_SUITE_P(Swims, GpuSwimming,
                         testing::Values(Swim{"thesis/creature-1", Scheme::conserving, false, true},
                                         Swim{"thesis/creature-2-vacuum", Scheme::conserving, false, false},
                                         Swim{"thesis/creature-2-vacuum", Scheme::conserving, true, false},
                                         Swim{"thesis/creature-1-vacuum", Scheme::flex, false, false}));

}  // namespace
}  // namespace natator::test
