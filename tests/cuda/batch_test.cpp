// A member's bits depend on nothing but itself: not on its slot, the batch's size, or the run.
#include <nlohmann/json.hpp>
#include <set>

#include "gpu_test.h"

namespace natator::test {
namespace {

class GpuBatch : public OnGpu<testing::TestWithParam<std::tuple<Scheme, Precision>>> {
protected:
    GpuBatch() {
        scene.scheme = std::get<0>(GetParam());
        scene.duration = 0.1;
    }
    Precision precision() const { return std::get<1>(GetParam()); }
    std::vector<BatchMember> members(int first, int count) const {
        std::vector<BatchMember> result;
        for (int k = first; k < first + count; ++k)
            result.push_back({wave(scene, k), {k % 3 == 0 ? 1e-6 : 0, static_cast<std::uint64_t>(k + 1)}});
        return result;
    }
    std::vector<std::uint64_t> hashes(const std::vector<BatchMember>& batch) const {
        std::vector<std::uint64_t> result;
        for (const Evaluation& one : evaluate_on_gpu(scene, batch, precision())) result.push_back(one.hash);
        return result;
    }
    Scene scene = load_scene("thesis/creature-1");
};

TEST_P(GpuBatch, AnyBatchSizeSlotAndRunGivesTheSameBits) {
    constexpr int most = 150;
    const std::vector<std::uint64_t> all = hashes(members(0, most));
    EXPECT_EQ(hashes(members(0, most)), all) << "a second run";
    for (const int k : {0, 1, 131, 132, 149}) EXPECT_EQ(hashes(members(k, 1)).front(), all[k]) << k << " alone";
    for (const int k : {0, 70, 147}) {
        const std::vector<std::uint64_t> three = hashes(members(k, 3));
        for (int e = 0; e < 3; ++e) EXPECT_EQ(three[e], all[k + e]) << k + e << " among three";
    }
    const std::vector<BatchMember> same(most, members(1, 1).front());
    EXPECT_EQ(hashes(same), std::vector<std::uint64_t>(most, all[1])) << "one gait in every slot";
    EXPECT_EQ(std::set<std::uint64_t>(all.begin(), all.end()).size(), all.size());
}

INSTANTIATE_TEST_SUITE_P(Schemes, GpuBatch,
                         testing::Combine(testing::Values(Scheme::flex, Scheme::conserving),
                                          testing::Values(Precision::single_precision, Precision::double_precision)),
                         [](const auto& test) {
                             return name_of(std::get<0>(test.param)) +
                                    (std::get<1>(test.param) == Precision::double_precision ? "Double" : "Float");
                         });

/// A member that stops early, or becomes unstable, leaves the others as they are.
TEST(GpuBatchEnds, AMemberThatStopsEarlyChangesNoOther) {
    if (cuda_devices().empty()) GTEST_SKIP() << "no GPU here";
    Scene scene = creature_scene(1, Scheme::flex);
    scene.duration = 0.5;
    scene.stopping.no_progress_after = 0.2;
    Gait slack = wave(scene), strong = wave(scene);
    slack.amplitude.assign(slack.amplitude.size(), 0);
    const std::vector<Evaluation> both = evaluate_on_gpu(scene, {{slack, {}}, {strong, {}}});
    EXPECT_EQ(both[1].hash, evaluate_on_gpu(scene, {{strong, {}}})[0].hash);
    EXPECT_EQ(both[0].hash, evaluate_on_gpu(scene, {{slack, {}}})[0].hash);
    EXPECT_EQ(both[0].stopped, evaluate(scene, slack).stopped);
    EXPECT_EQ(both[0].frames, evaluate(scene, slack).frames);
}

}  // namespace
}  // namespace natator::test
