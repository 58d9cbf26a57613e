// A member that can't be used costs the others of its batch nothing: what goes to the device, and how often.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "natator/batch.h"
#include "natator/error.h"
#include "scene/scene_json.h"

namespace natator {
namespace {

Gait gait(double amplitude) {
    return {1, {amplitude, 0.5}, {0, 0.25}, 1};
}

/// Stands for the GPU: notes its launches. A member's distance is its amplitude.
struct Device {
    std::vector<std::vector<double>> launches;
    std::size_t most = SIZE_MAX;  ///< members that memory does for

    EvaluateTogether evaluator() {
        return [this](const std::vector<BatchMember>& members) {
            launches.emplace_back();
            std::vector<Evaluation> evaluations;
            for (const BatchMember& member : members) {
                launches.back().push_back(member.gait.amplitude[0]);
                evaluations.emplace_back().distance = member.gait.amplitude[0];
            }
            if (members.size() > most) throw std::bad_alloc();
            return evaluations;
        };
    }
};

class EvaluateMembers : public testing::Test {
protected:
    std::vector<MemberResult> run(const std::vector<double>& amplitudes) {
        std::vector<BatchMember> members;
        for (const double amplitude : amplitudes) members.push_back({gait(amplitude), {}});
        return evaluate_members(scene, members, device.evaluator());
    }
    static double distance(const MemberResult& result) { return std::get<Evaluation>(result).distance; }
    static std::string error(const MemberResult& result) { return std::get<std::string>(result); }

    Scene scene = load_scene("thesis/creature-1-vacuum");
    Device device;
};

TEST_F(EvaluateMembers, GoodOnesGoTogether) {
    const std::vector<double> amplitudes{0.1, 0.2, 0.3};
    const auto results = run(amplitudes);
    ASSERT_EQ(device.launches.size(), 1u);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(distance(results[k]), amplitudes[k]) << k;
}

TEST_F(EvaluateMembers, ABadOneIsToldAndTheOthersGoTogether) {
    std::vector<double> amplitudes(48, 0.5);
    amplitudes[7] = -1e-17;
    amplitudes[40] = 3;
    const auto results = run(amplitudes);
    ASSERT_EQ(device.launches.size(), 1u);
    EXPECT_EQ(device.launches[0], std::vector<double>(46, 0.5));
    EXPECT_NE(error(results[7]).find("gait.amplitude[0] = -1e-17"), std::string::npos) << error(results[7]);
    EXPECT_NE(error(results[40]).find("gait.amplitude[0] = 3"), std::string::npos) << error(results[40]);
    for (std::size_t k = 0; k < results.size(); ++k) {
        if (k != 7 && k != 40) {
            EXPECT_EQ(distance(results[k]), 0.5) << k;
        }
    }
}

TEST_F(EvaluateMembers, NothingIsLaunchedForNothing) {
    EXPECT_EQ(run({}).size(), 0u);
    EXPECT_EQ(run({-1, 3}).size(), 2u);
    EXPECT_TRUE(device.launches.empty());
}

/// What is wrong with the scene is wrong with all: no need to try them one by one.
TEST_F(EvaluateMembers, AWrongSceneIsToldToAllAtOnce) {
    scene.planes = {{{0, 1, 0}, -5}};
    for (const MemberResult& result : run({0.1, 0.2, 0.3}))
        EXPECT_NE(error(result).find("outside the tank"), std::string::npos);
    scene.planes.clear();
    scene.duration = 1e5;
    scene.solver.substeps = scene.solver.iterations = 1000;
    for (const MemberResult& result : run({0.1, 0.2, 0.3}))
        EXPECT_NE(error(result).find("pair visits"), std::string::npos);
    EXPECT_TRUE(device.launches.empty());
}

TEST_F(EvaluateMembers, ADeviceThatIsNotThereIsToldToAllAtOnce) {
    int launches = 0;
    const auto results =
        evaluate_members(scene, {{gait(0.1), {}}, {gait(0.2), {}}}, [&](const auto&) -> std::vector<Evaluation> {
            ++launches;
            throw NoDevice("no device 7");
        });
    EXPECT_EQ(launches, 1);
    for (const MemberResult& result : results) EXPECT_EQ(error(result), "no device 7");
}

/// Memory that does for one and not for all loses none.
TEST_F(EvaluateMembers, HalvesAreTriedWhereTheWholeFails) {
    device.most = 2;
    const std::vector<double> amplitudes{0.1, 0.2, 0.3, 0.4, 0.5};
    const auto results = run(amplitudes);
    EXPECT_EQ(device.launches.size(), 5u);  // 5 fail; 2; 3 fail; 1; 2
    for (std::size_t k = 0; k < results.size(); ++k) EXPECT_EQ(distance(results[k]), amplitudes[k]);
    device.most = 0;
    for (const MemberResult& result : run({0.1, 0.2, 0.3})) EXPECT_EQ(error(result), "out of memory");
}

}  // namespace
}  // namespace natator
