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
    Scene scene =
        load_scene(swim.scene, {{"duration", 0.15},
                                {"solver", {{"substeps", 4}, {"solidIterations", 3}, {"kinematicViscosity", 0.01}}},
                                {"settling", {{"updates", 3}}}});
    scene.scheme = swim.scheme;
    Gait gait = wave(scene);
    gait.frequency = 7.4;
    const BatchMember member{gait, {1e-4, 3}};
    const Evaluation cpu =
        evaluate(scene, gait, {.precision = Precision::double_precision, .perturbation = member.perturbation});
    const std::vector<Evaluation> both = evaluate_on_gpu(
        scene, {member, {wave(scene), {}}}, {.precision = Precision::double_precision, .whole_gpu = swim.whole_gpu});
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

/// Scenes with more than one straight swim in a tank: what the host does between frames, and places of bodies.
class GpuTasks : public OnGpu<testing::Test> {
protected:
    static void compare(const std::string& name, const nlohmann::json& overrides,
                        const std::vector<double>& offset = {}) {
        nlohmann::json all{{"duration", 0.15}, {"solver", {{"solidIterations", 3}}}, {"settling", {{"updates", 3}}}};
        all.merge_patch(overrides);
        const Scene scene = load_scene(name, all);
        Gait gait = wave(scene);
        gait.offset = offset;
        const Evaluation cpu = evaluate(scene, gait, {.precision = Precision::double_precision});
        const Evaluation gpu =
            evaluate_on_gpu(scene, {{gait, {}}, {wave(scene), {}}}, {.precision = Precision::double_precision}).front();
        constexpr double bound = 1e-6;
        EXPECT_NEAR(gpu.distance, cpu.distance, bound);
        EXPECT_EQ(gpu.stopped, cpu.stopped);
        EXPECT_NEAR(gpu.fitness(), cpu.fitness(), 100 * bound);
        ASSERT_EQ(gpu.goals.size(), cpu.goals.size());
        ASSERT_EQ(gpu.companions.size(), cpu.companions.size());
        for (std::size_t k = 0; k < cpu.companions.size(); ++k)
            EXPECT_NEAR(gpu.companions[k].distance, cpu.companions[k].distance, bound);
        ASSERT_EQ(gpu.renewal.has_value(), cpu.renewal.has_value());
        if (!cpu.renewal) return;
        EXPECT_GT(cpu.renewal->times, 0);
        EXPECT_EQ(gpu.renewal->times, cpu.renewal->times);
        EXPECT_EQ(gpu.renewal->particles, cpu.renewal->particles);
        EXPECT_NEAR((gpu.renewal->momentum - cpu.renewal->momentum).norm(), 0, 1e-3);
    }
};

TEST_F(GpuTasks, AMovingTankIsTheCpus) {
    compare("endless/creature-2", {{"movingTank", {{"step", 0.0005}, {"current", {-0.3, 0, 0}}}}});
}

TEST_F(GpuTasks, GoalsAndOffsetsAreTheCpus) {
    const std::vector<double> offset(8, -0.3);
    compare("goals/turn", {{"movingTank", {{"step", 0.0005}}}}, offset);
    compare("thesis/creature-2", {{"goals", {{{"measure", "turn"}, {"target", 90}}}}}, offset);
}

TEST_F(GpuTasks, CompanionsAndObstaclesAreTheCpus) {
    compare("company/school", nlohmann::json::object());
    compare("company/pillars", nlohmann::json::object());
    compare("company/hoop", nlohmann::json::object());
}

}  // namespace
}  // namespace natator::test
