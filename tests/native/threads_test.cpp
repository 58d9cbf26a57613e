// Threads inside one evaluation, and evaluations in several threads: no bit of the result depends on their number.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "natator/evaluate.h"
#include "natator/measure.h"
#include "natator/simulation.h"
#include "scene/scene_json.h"
#include "solver/cpu/thread_team.h"

namespace natator {
namespace {

TEST(ThreadTeamTest, PartsCoverTheLoopOnce) {
    for (const int threads : {1, 2, 3, 7}) {
        cpu::ThreadTeam team(threads);
        for (const int count : {0, 1, 9, 10, 20, 50, 1001}) {
            std::vector<int> visits(count, 0);
            std::vector<int> parts(team.max_parts(), 0);
            team.for_parts(count, 10, [&](int part, int begin, int end) {
                parts[part] = 1;
                for (int k = begin; k < end; ++k) ++visits[k];
            });
            EXPECT_EQ(visits, std::vector<int>(count, 1)) << threads << " " << count;
            int expected = std::max(1, std::min(team.max_parts(), count / 10));
            if (expected > threads) expected = expected / threads * threads;  // as many for each
            EXPECT_EQ(std::accumulate(parts.begin(), parts.end(), 0), expected) << threads << " " << count;
        }
    }
}

/// More threads than processors: helpers come late to loops that are over, whose work is gone.
TEST(ThreadTeamTest, NoHelperWorksOnALoopThatIsOver) {
    cpu::ThreadTeam team(8);
    for (int loop = 0; loop < 3000; ++loop) {
        std::vector<int> done(64, 0);
        team.for_each(64, 2, [&](int k) { ++done[k]; });
        ASSERT_EQ(done, std::vector<int>(64, 1)) << loop;
    }
}

TEST(ThreadTeamTest, WhatAPartThrowsIsThrownAndTheTeamGoesOn) {
    cpu::ThreadTeam team(3);
    for (const int bad : {0, 1, 2}) {
        const auto fail = [bad](int part, int, int) {
            if (part == bad) throw std::runtime_error("part " + std::to_string(part));
        };
        EXPECT_THROW(team.for_parts(30, 1, fail), std::runtime_error) << bad;
    }
    int sum = 0;
    team.for_parts(2, 2, [&](int, int begin, int end) { sum += end - begin; });
    EXPECT_EQ(sum, 2);
}

/// Fluid enough for three parts, with a swimmer in it.
TEST(Threads, AnyNumberGivesTheSameBits) {
    const nlohmann::json large = {
        {"fluid", {{"count", {100, 10, 34}}}},
        {"planes", {{0, 1, 0, 0}, {0, 0, 1, 0}, {1, 0, 0, 0}, {-1, 0, 0, 9.01}, {0, 0, -1, 3.07}}},
        {"settling", {{"updates", 1}}},
        {"duration", 0.02}};
    for (const char* scheme : {"flex", "conserving"}) {
        Scene scene = load_scene("thesis/creature-1", large);
        scene.scheme = scheme == std::string("flex") ? Scheme::flex : Scheme::conserving;
        const Gait gait{.frequency = 1.8, .amplitude = {0.9, 0.7}, .phase = {0, 0.6}};
        const Evaluation alone = evaluate(scene, gait);
        for (const int threads : {2, 3}) {
            const Evaluation shared = evaluate(scene, gait, {.execution = {.threads = threads}});
            EXPECT_EQ(shared.hash, alone.hash) << scheme << " " << threads;
            EXPECT_EQ(shared.errors.density_error_mean, alone.errors.density_error_mean);
        }
    }
}

/// Calls `work` with 0, 1 ... in as many threads.
template <class Work>
std::vector<std::uint64_t> in_threads(int count, const Work& work) {
    std::vector<std::uint64_t> results(count);
    std::vector<std::thread> threads;
    for (int k = 0; k < count; ++k) threads.emplace_back([&, k] { results[k] = work(k); });
    for (std::thread& thread : threads) thread.join();
    return results;
}

/// Of several scenes at once, of which each thread has its own, also where it is the same.
TEST(Threads, EvaluationsAndSimulationsRunSideBySide) {
    const Gait gait{.frequency = 1.8, .amplitude = {0.9, 0.7}, .phase = {0, 0.6}};
    const auto scene_of = [](int k) {
        Scene scene = load_scene("bench/small-tank", {{"settling", {{"updates", 3}}}, {"duration", 0.05}});
        scene.scheme = k / 2 % 2 == 0 ? Scheme::flex : Scheme::conserving;
        return scene;
    };
    const auto run = [&](int k) {
        const Scene scene = scene_of(k);
        if (k % 2 == 0) return evaluate(scene, gait).hash;
        Simulation simulation(scene);
        while (simulation.frames() < 3) simulation.step(gait);
        return state_hash(simulation.state());
    };
    std::vector<std::uint64_t> alone(8);
    for (int k = 0; k < 8; ++k) alone[k] = run(k);
    EXPECT_EQ(alone[0], alone[1]);
    EXPECT_EQ(alone[2], alone[3]);
    EXPECT_EQ(in_threads(8, run), alone);

    Simulation simulation(scene_of(0));
    ASSERT_TRUE(simulation.step(gait));
    const Simulation<float>& seen = simulation;
    const auto look = [&](int) {
        return state_hash(seen.state()) + static_cast<std::uint64_t>(1e6 * seen.driven().front());
    };
    EXPECT_EQ(in_threads(4, look), std::vector<std::uint64_t>(4, look(0)));
}

}  // namespace
}  // namespace natator
