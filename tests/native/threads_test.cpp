// Threads inside one evaluation: no bit of the result depends on their number.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>

#include "natator/evaluate.h"
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

}  // namespace
}  // namespace natator
