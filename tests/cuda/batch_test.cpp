// A member's bits depend on nothing but itself: not on its slot, the batch's size, or the run.
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <thread>

#include "gpu_test.h"
#include "natator/error.h"
#include "natator/measure.h"
#include "natator/model.h"
#include "natator/settled_state_cache.h"
#include "natator/simulation.h"

namespace natator::test {
namespace {

class GpuThreads : public OnGpu<testing::Test> {};

/// Scenes whose kernels need different amounts of shared memory, set up by several threads at once, as `serve` does.
TEST_F(GpuThreads, UnlikeScenesDoNotDisturbOneAnother) {
    constexpr int rounds = 60;
    std::vector<std::uint64_t> alone;
    const auto evaluated = [](int creature) {
        const nlohmann::json brief{{"duration", 0.0167}, {"settling", {{"updates", 1}}}};
        const Scene scene = load_scene("thesis/creature-" + std::to_string(creature), brief);
        return evaluate_on_gpu(scene, {{wave(scene), {}}}, {}).front().hash;
    };
    for (int creature = 1; creature <= 4; ++creature) alone.push_back(evaluated(creature));
    std::vector<std::thread> threads;
    std::vector<std::string> faults(4);
    for (int k = 0; k < 4; ++k)
        threads.emplace_back([&, k] {
            try {
                for (int round = 0; round < rounds; ++round)
                    if (evaluated(1 + (k + round) % 4) != alone[(k + round) % 4]) faults[k] = "other bits";
            } catch (const std::exception& error) {
                faults[k] = error.what();
            }
        });
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(faults, std::vector<std::string>(4));
}

std::vector<std::uint64_t> hashes_of(const Scene& scene, const std::vector<BatchMember>& batch, Precision precision) {
    std::vector<std::uint64_t> result;
    for (const Evaluation& one : evaluate_on_gpu(scene, batch, {.precision = precision})) result.push_back(one.hash);
    return result;
}

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
        return hashes_of(scene, batch, precision());
    }
    Scene scene = load_scene("thesis/creature-1");
};

/// A Simulation on the GPU is a member that is looked at after each frame.
TEST_P(GpuBatch, ASimulationHasTheBitsOfAMember) {
    const auto after_frames = [&](auto simulation) {
        while (simulation.time() < scene.duration - scene.time_step / 2) EXPECT_TRUE(simulation.step(wave(scene)));
        return state_hash(simulation.state());
    };
    const std::uint64_t member = hashes({{wave(scene), {}}}).front();
    const Execution on_gpu{.gpu = 0};
    EXPECT_EQ(precision() == Precision::double_precision ? after_frames(Simulation<double>(scene, on_gpu))
                                                         : after_frames(Simulation<float>(scene, on_gpu)),
              member);
    EXPECT_EQ(evaluate(scene, wave(scene), {.precision = precision(), .execution = on_gpu}).hash, member);
}

TEST_P(GpuBatch, AnyBatchSizeSlotAndRunGivesTheSameBits) {
    constexpr int most = 150;
    const std::vector<std::uint64_t> all = hashes(members(0, most));
    EXPECT_EQ(hashes(members(0, most)), all) << "a second run";
    for (const int k : {0, 1, 131, 132, 149}) EXPECT_EQ(hashes(members(k, 1)).front(), all[k]) << k << " alone";
    for (const int k : {0, 70, 147}) {
        const std::vector<std::uint64_t> three = hashes(members(k, 3));
        for (int e = 0; e < 3; ++e) EXPECT_EQ(three[e], all[k + e]) << k + e << " among three";
    }
    for (const int count : {10, 20, 40, 80})  // by fewer and fewer multiprocessors each
        EXPECT_EQ(hashes(members(0, count)), std::vector(all.begin(), all.begin() + count)) << "the first " << count;
    const std::vector<BatchMember> same(most, members(1, 1).front());
    EXPECT_EQ(hashes(same), std::vector<std::uint64_t>(most, all[1])) << "one gait in every slot";
    EXPECT_EQ(std::set<std::uint64_t>(all.begin(), all.end()).size(), all.size());
}

/// Members with water in several arrangements, among them the scene's own, are computed together.
TEST_P(GpuBatch, ArrangementsOfTheWaterShareABatch) {
    scene.fluid->disorder = 7;
    std::vector<BatchMember> together = members(0, 12);
    for (int k = 0; k < 12; ++k)
        if (k % 4 > 0) together[k].arrangement = std::vector{0, 7, 3, 20}[k % 4];
    together.push_back(together[1]);
    together.back().arrangement = 3;
    const std::vector<std::uint64_t> all = hashes(together);
    EXPECT_EQ(all[12] == all[1], scene.scheme == Scheme::flex) << "another arrangement";
    for (const int k : {0, 1, 2, 3, 5, 11, 12}) {
        Scene own = scene;
        own.fluid->disorder = together[k].arrangement.value_or(7);
        const BatchMember alone{together[k].gait, together[k].perturbation};
        EXPECT_EQ(evaluate_on_gpu(own, {alone}, {.precision = precision()})[0].hash, all[k]) << k << " alone";
        if (precision() == Precision::double_precision && scene.scheme == Scheme::conserving && k == 1) {
            const EvaluationOptions options{.precision = precision(), .perturbation = alone.perturbation};
            EXPECT_NEAR(evaluate(own, alone.gait, options).distance,
                        evaluate_on_gpu(scene, together, {.precision = precision()})[k].distance, 1e-7);
        }
    }
}

/// Of so many particles that few are computed otherwise than many, in sizes whose tables end in a part of a tile.
TEST_P(GpuBatch, MembersOfLargeScenesGiveTheBitsThatTheyGiveAlone) {
    for (const std::array<int, 3>& count : {std::array{80, 11, 27}, std::array{100, 14, 34}, std::array{112, 15, 36}}) {
        scene = tank_of(count, scene.scheme);
        scene.duration = 2 * scene.time_step;
        const std::vector<std::uint64_t> all = hashes(members(0, 5));
        for (const int k : {0, 2, 4})
            EXPECT_EQ(hashes(members(k, 1)).front(), all[k]) << count[0] << " along x: " << k << " alone";
    }
}

/// Of fewer, but too many for the chip of a block.
TEST_P(GpuBatch, MembersOfMiddleScenesGiveTheBitsThatTheyGiveAlone) {
    scene = tank_of({70, 11, 20}, scene.scheme);
    scene.duration = scene.time_step;
    const std::vector<std::uint64_t> all = hashes(members(0, 140));
    for (const int k : {0, 1, 139}) EXPECT_EQ(hashes(members(k, 1)).front(), all[k]) << k << " alone";
    EXPECT_EQ(hashes(members(0, 20)), std::vector(all.begin(), all.begin() + 20));
}

/// Members that begin as in a batch before, or in this one.
TEST_P(GpuBatch, KeptStartsGiveTheSameBits) {
    scene.duration = 2 * scene.time_step;
    std::vector<BatchMember> batch{members(1, 1).front(), members(2, 1).front()};
    batch[1].arrangement = 1;
    const SettledStateCache starts(testing::TempDir() + "natator-batch-starts");
    std::filesystem::remove_all(starts.folder());
    const auto run = [&](bool keep, BatchTimes& times) {
        std::vector<std::uint64_t> found;
        const BatchOptions options{.precision = precision(), .times = &times, .starts = keep ? &starts : nullptr};
        for (const Evaluation& one : evaluate_on_gpu(scene, batch, options)) found.push_back(one.hash);
        return found;
    };
    BatchTimes settled, kept;
    const std::vector<std::uint64_t> fresh = run(false, settled);
    EXPECT_GT(settled.settling, 0);
    run(true, settled);
    EXPECT_EQ(run(true, kept), fresh);
    EXPECT_EQ(kept.settling, 0);
    scene.settling.updates += 1;
    EXPECT_NE(run(true, kept), fresh);
    EXPECT_GT(kept.settling, 0);
    std::filesystem::remove_all(starts.folder());
}

TEST_P(GpuBatch, TellsTheMemoryThatItTakes) {
    scene.duration = scene.time_step;
    const std::size_t number = precision() == Precision::double_precision ? 8 : 4;
    const std::size_t of_state = 2 * 4 * number * static_cast<std::size_t>(build_model(scene).particles());
    std::vector<std::size_t> memory;
    for (int run = 0; run < 2; ++run) {
        BatchTimes times;
        evaluate_on_gpu(scene, members(0, 3), {.precision = precision(), .times = &times});
        EXPECT_EQ(times.at_a_time, 3);
        memory.push_back(times.memory);
    }
    EXPECT_GT(memory[0], 3 * of_state) << "positions and velocities";
    EXPECT_LT(memory[0], std::size_t{1} << 30);
    const auto [least, most] = std::minmax(memory[0], memory[1]);
    const bool by_streams = scene.scheme == Scheme::conserving;  // side by side: what both have at a time differs
    EXPECT_LE(most - least, by_streams ? least / 100 : 0);
}

INSTANTIATE_TEST_SUITE_P(Schemes, GpuBatch,
                         testing::Combine(testing::Values(Scheme::flex, Scheme::conserving),
                                          testing::Values(Precision::single_precision, Precision::double_precision)),
                         [](const auto& test) {
                             return name_of(std::get<0>(test.param)) +
                                    (std::get<1>(test.param) == Precision::double_precision ? "Double" : "Float");
                         });

/// Scenes whose solids have a block for themselves where States are few, or are too many for that; beside the fluid on
/// one chip.
struct SolidCase {
    const char* name;
    const char* overrides;
};
class GpuTeams : public OnGpu<testing::TestWithParam<SolidCase>> {};

TEST_P(GpuTeams, OfManyBlocksGiveTheBitsOfFewer) {
    Scene scene = load_scene("thesis/creature-2", nlohmann::json::parse(GetParam().overrides));
    scene.duration = 0.1;
    std::vector<BatchMember> members;
    for (int k = 0; k < 140; ++k) members.push_back({wave(scene, k), {1e-6, static_cast<std::uint64_t>(k + 1)}});
    for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
        const std::vector<std::uint64_t> all = hashes_of(scene, members, precision);
        EXPECT_NE(all[0], all[1]);
        for (const int count : {1, 2, 4, 9, 20, 50})
            EXPECT_EQ(hashes_of(scene, {members.begin(), members.begin() + count}, precision),
                      std::vector(all.begin(), all.begin() + count))
                << "the first " << count;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Solids, GpuTeams,
    testing::Values(SolidCase{"AsTheyAre", "{}"},
                    SolidCase{"WithoutClusters", R"({"creature": {"clusterStiffness": 0}})"},
                    SolidCase{"WithoutSprings", R"({"creature": {"springStiffness": 0}})"},
                    SolidCase{"WithoutFluid", R"({"fluid": null})"},
                    SolidCase{"BesideAnObstacle",
                              R"({"obstacles": [{"shape": "sphere", "centre": [2.4, 0.6, 0.6], "radius": 0.2}]})"},
                    SolidCase{"OfThreeBodies",
                              R"({"companions": [{"creature": {"name": "creature-3", "rearCentre": [0.6, 0.6, 0.25]}},
                                                      {"creature": {"name": "creature-4", "rearCentre": [2.2, 0.6, 0.9]}}]})"},
                    SolidCase{"InOtherWater",
                              R"({"solver": {"cohesion": 0.02, "solidPressure": 0.5, "viscosity": 0, "damping": 0}})"},
                    SolidCase{"WithManyNeighbours", R"({"fluid": {"spacing": 0.07}})"},
                    SolidCase{
                        "WithEffects",
                        R"({"solver": {"restitution": 0.5, "adhesion": 20, "cohesion": 0.02, "surfaceTension": 0.5,
                                     "vorticityConfinement": 0.5, "freeSurfaceDrag": 1, "dissipation": 3,
                                     "shockPropagation": 1.5}})"}),
    [](const auto& test) { return std::string(test.param.name); });

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

/// A gait that is refused costs the others no launch of their own, and changes no bit of theirs.
TEST(GpuBatchEnds, AMemberThatIsRefusedCostsTheOthersNothing) {
    if (cuda_devices().empty()) GTEST_SKIP() << "no GPU here";
    Scene scene = creature_scene(1, Scheme::flex);
    scene.duration = 0.1;
    std::vector<BatchMember> good, members;
    for (int k = 0; k < 48; ++k) {
        members.push_back({wave(scene, k), {}});
        if (k == 5)
            members.back().gait.amplitude[0] = -1e-17;
        else
            good.push_back(members.back());
    }
    int launches = 0;
    const auto together = [&](const std::vector<BatchMember>& some) {
        ++launches;
        return evaluate_on_gpu(scene, some);
    };
    const std::vector<MemberResult> results = evaluate_members(scene, members, together);
    EXPECT_EQ(launches, 1);
    EXPECT_NE(std::get<std::string>(results[5]).find("gait.amplitude[0]"), std::string::npos);
    const std::vector<Evaluation> alone = evaluate_on_gpu(scene, good);
    for (std::size_t k = 0; k < good.size(); ++k)
        EXPECT_EQ(std::get<Evaluation>(results[k < 5 ? k : k + 1]).hash, alone[k].hash) << k;
}

/// Starts that fail while they settle, or runs that become unstable, beside ones that do not: each member is as it is
/// alone. Shifts of up to 1 pile particles up, which this relaxation throws apart without end; unshifted it holds.
TEST(GpuBatchEnds, AnUnstableMemberChangesNoOther) {
    if (cuda_devices().empty()) GTEST_SKIP() << "no GPU here";
    for (const auto& [updates, factor] : {std::pair(0, 0.5), {100, 0.4}}) {
        Scene scene =
            load_scene("bench/small-tank", {{"solver", {{"relaxationMode", "global"}, {"relaxationFactor", factor}}}});
        scene.duration = 0.1;
        scene.settling.updates = updates;
        scene.stopping.plane_contact = false;
        std::vector<BatchMember> members;
        for (const int k : {1, 2, 3, 4, 5, 6})
            members.push_back({wave(scene, k), {k % 2 == 0 ? 1.0 : 0.0, static_cast<std::uint64_t>(k)}});
        const std::vector<Evaluation> all = evaluate_on_gpu(scene, members);
        int unstable = 0;
        for (std::size_t k = 0; k < members.size(); ++k) {
            const Evaluation alone = evaluate_on_gpu(scene, {members[k]}).front();
            EXPECT_EQ(all[k].hash, alone.hash) << k;
            EXPECT_EQ(all[k].stopped, alone.stopped) << k;
            EXPECT_EQ(all[k].instability.has_value(), alone.instability.has_value()) << k;
            if (alone.instability) {
                ++unstable;
                EXPECT_EQ(all[k].instability->time, alone.instability->time) << k;
            }
        }
        EXPECT_GT(unstable, 0) << updates;
        EXPECT_LT(unstable, 6) << updates;
    }
}

}  // namespace
}  // namespace natator::test
