// Several swimmers of one water, each driven and sensing by itself.
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "lattice_company.h"
#include "natator/error.h"
#include "natator/load_scene.h"
#include "natator/measure.h"
#include "natator/simulation.h"
#include "refusal_of.h"
#include "small_pair.h"

namespace natator {
namespace {

using nlohmann::json;

SimulationSetup pair_in(const std::string& scheme, json changes = json::object()) {
    if (scheme == "lattice") {
        changes.merge_patch({{"settling", {{"updates", 0}}}});
        return {"plane/pair", test::pair_json(changes).dump()};
    }
    json overrides = test::small_pair;
    overrides["scheme"] = scheme;
    overrides.merge_patch(changes);
    return {"bench/small-tank", overrides.dump()};
}

/// A gait of so many actuators, other than any scene's.
Gait beat(int actuators) {
    Gait gait = resting_gait(actuators);
    gait.frequency = 3;
    for (int i = 0; i < actuators; ++i) gait.amplitude[i] = 0.6, gait.phase[i] = 0.25 + 0.3 * i / actuators;
    return gait;
}

std::uint64_t hash_of_swim(Simulation<float>& simulation, int frames) {
    for (int frame = 0; frame < frames; ++frame) EXPECT_TRUE(simulation.step());
    return state_hash(simulation.state());
}

class Swimmers : public testing::TestWithParam<std::string> {
protected:
    static constexpr int frames = 4;
    const double gently = GetParam() == "lattice" ? 0.1 : 1;  ///< what a loach can do in a frame
};

TEST_P(Swimmers, AGaitThatACompanionGetsIsAsGoodAsItsScenes) {
    Simulation<float> told(pair_in(GetParam())), plain(pair_in(GetParam()));
    const Gait next = beat(told.model().actuators_of(1));
    told.set_gait(next, 1);
    EXPECT_EQ(told.gait(1), next);
    json companions = json::parse(plain.setup().overrides).value("companions", json());
    if (companions.is_null()) {
        const json loach{{"name", "loach"}, {"particleMass", 1}, {"rearCentre", {0.8, 0.01, 1.16}}};
        companions = json::array({{{"creature", loach}}});
    }
    companions[0]["gait"] = {{"frequency", next.frequency}, {"amplitude", next.amplitude}, {"phase", next.phase}};
    Simulation<float> made(pair_in(GetParam(), {{"companions", companions}}));
    const std::uint64_t expected = hash_of_swim(made, frames);
    EXPECT_EQ(hash_of_swim(told, frames), expected);
    EXPECT_NE(hash_of_swim(plain, frames), expected);

    told.reset();  // keeps it
    EXPECT_EQ(hash_of_swim(told, frames), expected);
    EXPECT_FALSE(told.merge_overrides(R"({"solver": {"damping": 0.1}})"));  // as do settings
    EXPECT_EQ(told.gait(1), next);
    const Steering strongest{std::vector<double>(next.amplitude.size(), 3), std::vector<double>(next.amplitude.size())};
    told.steer(strongest, 1);
    companions[0]["gait"]["amplitude"][0] = 1;
    const std::string patch = json{{"companions", companions}}.dump();
    EXPECT_NE(test::refusal_of([&] { told.merge_overrides(patch); }).find("must be at most 2, is 3"),
              std::string::npos);
    EXPECT_EQ(told.gait(1), next);
    told.steer(no_steering(static_cast<int>(next.amplitude.size())), 1);
    told.reset();
    EXPECT_FALSE(told.merge_overrides(patch));
    EXPECT_EQ(told.gait(1).amplitude[0], 1);
}

TEST_P(Swimmers, EachIsDrivenByItself) {
    const auto run = [](const std::vector<double>& first, const std::vector<double>& second, int threads) {
        Execution execution;
        execution.threads = threads;
        Simulation<float> simulation(pair_in(GetParam()), execution);
        if (!first.empty()) simulation.drive(first);
        if (!second.empty()) simulation.drive(second, 1);
        const std::uint64_t hash = hash_of_swim(simulation, frames);
        EXPECT_TRUE(first.empty() || simulation.driven() == first);
        EXPECT_TRUE(second.empty() || simulation.driven(1) == second);
        return hash;
    };
    const Simulation<float> like(pair_in(GetParam()));
    const std::vector<double> own(like.model().actuators_of(0), 0.7 * gently),
        other(like.model().actuators_of(1), -0.6 * gently);
    const std::uint64_t both = run(own, other, 1);
    EXPECT_EQ(run(own, other, 2), both);
    EXPECT_NE(run(own, {}, 1), both);
    EXPECT_NE(run({}, other, 1), both);
}

TEST_P(Swimmers, WorkAndDistanceAreOfEach) {
    for (const int swimmer : {0, 1}) {
        Simulation<float> simulation(pair_in(GetParam()));
        for (const int k : {0, 1}) simulation.set_gait(resting_gait(simulation.model().actuators_of(k)), k);
        simulation.drive(std::vector<double>(simulation.model().actuators_of(swimmer), 0.8 * gently), swimmer);
        hash_of_swim(simulation, frames);
        EXPECT_EQ(simulation.muscle_work(1 - swimmer), 0);
        EXPECT_EQ(simulation.muscle_work(swimmer) != 0, GetParam() != "flex");
        const Body& body = simulation.model().body_of(swimmer);
        const double begin = mean_x(body, initial_state<float>(simulation.model()));
        EXPECT_NEAR(simulation.distance(swimmer), mean_x(body, simulation.state()) - begin, 0.02);
        EXPECT_NE(simulation.distance(0), simulation.distance(1));
    }
}

INSTANTIATE_TEST_SUITE_P(Schemes, Swimmers, testing::Values("flex", "conserving", "lattice"),
                         [](const auto& scheme) { return scheme.param; });

TEST(SwimmersTest, ScaledByHalfIsAGaitOfHalfTheAmplitudes) {
    Simulation<float> scaled(pair_in("flex")), halved(pair_in("flex"));
    Gait gait = scaled.gait(1);
    scaled.steer({{0.5, 0.5, 0.5}, {0, 0, 0}}, 1);
    for (double& amplitude : gait.amplitude) amplitude /= 2;
    halved.set_gait(gait, 1);
    EXPECT_EQ(hash_of_swim(scaled, 4), hash_of_swim(halved, 4));
    EXPECT_EQ(scaled.steering(1).scale[0], 0.5);
    EXPECT_EQ(scaled.steering().scale[0], 1);
}

/// A companion senses what it would as the scene's creature.
TEST(SwimmersTest, ACompanionSensesAsACreatureDoes) {
    Simulation<float> simulation(pair_in("conserving"));
    simulation.drive({0.5, -0.5, 0.4}, 1);
    hash_of_swim(simulation, 3);
    const Model& pair = simulation.model();
    Model swapped = pair;
    std::swap(swapped.body, swapped.companions[0].body);
    swapped.actuators = 3;
    swapped.companions[0].first_actuator = 3;
    swapped.companions[0].gait = resting_gait(2);
    for (Muscle& muscle : swapped.muscles)
        muscle.actuator = muscle.actuator < 2 ? muscle.actuator + 3 : muscle.actuator - 2;
    const Sensing sensing{.flow = {{1, SkinPlace::Side::left}, {4, SkinPlace::Side::above}},
                          .target = Eigen::Vector3d(1, 0.5, 0.4)};
    const Senses seen = sense(pair, simulation.state(), sensing, 1),
                 expected = sense(swapped, simulation.state(), sensing);
    EXPECT_EQ(seen.centre, expected.centre);
    EXPECT_EQ(seen.axes, expected.axes);
    EXPECT_EQ(seen.velocity, expected.velocity);
    EXPECT_EQ(seen.turn_rate, expected.turn_rate);
    EXPECT_EQ(seen.bend, expected.bend);
    EXPECT_EQ(seen.bend.size(), 3u);
    EXPECT_NE(seen.bend[0], 0);
    EXPECT_EQ(seen.target, expected.target);
    EXPECT_EQ(seen.flow[0].velocity, expected.flow[0].velocity);
    EXPECT_GT(seen.flow[0].particles, 0);
    EXPECT_NE(seen.centre, sense(pair, simulation.state(), sensing).centre);
    EXPECT_FALSE(touches_plane(pair, simulation.state(), 1));
    Model walled = pair;
    walled.planes.push_back({{0, 0, -1}, 1.2});
    EXPECT_TRUE(touches_plane(walled, simulation.state(), 1));
    EXPECT_FALSE(touches_plane(walled, simulation.state()));
}

TEST(SwimmersTest, WhatDoesNotFitIsRefusedAndChangesNothing) {
    Simulation<float> simulation(pair_in("flex")), untouched(pair_in("flex"));
    const double none = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(test::refusal_of([&] { simulation.drive({0, 0, 0}, 2); }),
              "swimmer = 2: must be in [0, 1], the creature and its companions");
    EXPECT_EQ(test::refusal_of([&] { simulation.set_gait(beat(3), -1); }),
              "swimmer = -1: must be in [0, 1], the creature and its companions");
    EXPECT_EQ(test::refusal_of([] { Simulation<float>(SimulationSetup{"thesis/creature-1-vacuum"}).driven(1); }),
              "swimmer = 1: must be 0, as the scene has no companions");
    EXPECT_EQ(test::refusal_of([&] { simulation.drive({0, 0}, 1); }),
              "drive has length 2: must have length 3, one value per actuator of the creature");
    EXPECT_EQ(test::refusal_of([&] { simulation.drive({0, none, 0}, 1); }),
              "drive[1] = NaN: must be a number in [-2, 2]");
    EXPECT_NE(test::refusal_of([&] { simulation.steer({{4, 4, 4}, {0.5, 0, 0}}, 1); }).find("must be at most 2"),
              std::string::npos);
    EXPECT_NE(test::refusal_of([&] { simulation.set_gait(beat(2), 1); }).find("must have length 3"), std::string::npos);
    EXPECT_EQ(hash_of_swim(simulation, 2), hash_of_swim(untouched, 2));
    const Model model = build_model(load_scene("bench/small-tank", SceneOptions{test::small_pair.dump()}));
    State<double> state = initial_state<double>(model);
    EXPECT_NE(test::refusal_of([&] { actuate(model, std::vector<double>(4), 0, state); }).find("must have length 2"),
              std::string::npos);
    Model wrong = model;
    wrong.companions[0].first_spring = 1 << 20;
    EXPECT_NE(test::refusal_of([&] { Solver<float>{wrong}; }).find("companions[0].first_spring = 1048576"),
              std::string::npos);
    wrong = model;
    wrong.companions[0].first_actuator = 1;
    EXPECT_EQ(test::refusal_of([&] { Solver<float>{wrong}; }),
              "model: companions[0].first_actuator = 1: must be 2, the number of actuators before");
}

}  // namespace
}  // namespace natator
