// Scenes that are changed while they run.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "natator/error.h"
#include "natator/evaluate.h"
#include "natator/measure.h"
#include "natator/model.h"
#include "natator/simulation.h"
#include "run/settle.h"
#include "scene/scene_json.h"

namespace natator {
namespace {

using nlohmann::json;

const Gait swimming{1.861, {0.973, 0.690}, {0, 0.648}, 1};
const std::string in_water = "bench/small-tank", in_vacuum = "thesis/creature-1-vacuum";
/// Water that need not be at rest for what is tried.
const json hardly_settled{{"settling", {{"updates", 2}}}};

template <class Real>
std::uint64_t hash_after(Simulation<Real>& simulation, int frames) {
    while (simulation.frames() < frames) EXPECT_TRUE(simulation.step());
    return state_hash(simulation.state());
}

Simulation<float> swimmer(const std::string& scene, const json& overrides = json::object()) {
    return Simulation<float>({scene, overrides.dump(), swimming});
}

bool merge(Simulation<float>& simulation, const json& patch) {
    return simulation.merge_overrides(patch.dump());
}

/// What `evaluate` gives for so many frames, early stops aside.
Evaluation evaluated(const std::string& scene, int frames, const json& overrides = json::object(),
                     Precision precision = Precision::single_precision) {
    Scene whole = load_scene(scene, overrides);
    whole.duration = frames * whole.time_step;
    whole.stopping = {false, 0};
    return evaluate(whole, swimming, {.precision = precision});
}

TEST(SimulationTest, BeginsWithTheSettledStart) {
    Simulation<float> simulation = swimmer(in_water);
    const Scene scene = load_scene(in_water);
    const Model model = build_model(scene);
    Solver<float> solver(model);
    State<float> settled = initial_state<float>(model);
    ASSERT_FALSE(settle(scene.settling, solver, settled));
    EXPECT_EQ(state_hash(simulation.state()), state_hash(settled));
    EXPECT_EQ(simulation.frames(), 0);
    EXPECT_EQ(simulation.state().time, 0);
    EXPECT_EQ(simulation.distance(), 0);
}

/// The short path: a scene that the program holds, and a gait.
TEST(SimulationTest, OfASceneStepsByTheGaitItIsGiven) {
    const Scene scene = load_scene(in_water, hardly_settled);
    Simulation simulation(scene);
    EXPECT_EQ(simulation.time(), 0);
    for (int k = 0; k < 3; ++k) ASSERT_TRUE(simulation.step(swimming));
    const Evaluation expected = evaluated(in_water, 3, hardly_settled);
    EXPECT_EQ(state_hash(simulation.state()), expected.hash);
    EXPECT_EQ(simulation.time(), expected.simulated);
    EXPECT_EQ(simulation.distance(), expected.distance);
    EXPECT_EQ(simulation.gait(), swimming);

    Simulation moved = std::move(simulation);
    EXPECT_THROW(moved.step(Gait{}), InputError);
    EXPECT_THROW(merge(moved, {{"duration", 1}}), InputError);
    EXPECT_EQ(hash_after(moved, 5), evaluated(in_water, 5, hardly_settled).hash);
}

TEST(SimulationTest, FramesAreThoseOfAnEvaluationBitByBit) {
    for (const char* scheme : {"flex", "conserving"}) {
        const json overrides{{"scheme", scheme}, {"settling", {{"updates", 2}}}};
        Simulation<float> simulation = swimmer(in_water, overrides);
        for (const int frames : {1, 2, 5}) {
            const Evaluation expected = evaluated(in_water, frames, overrides);
            EXPECT_EQ(hash_after(simulation, frames), expected.hash) << scheme << ", frame " << frames;
            EXPECT_EQ(simulation.distance(), expected.distance);
            EXPECT_EQ(simulation.state().time, expected.simulated);
        }
    }
    Simulation<double> in_double({in_vacuum, {}, swimming});
    EXPECT_EQ(hash_after(in_double, 5), evaluated(in_vacuum, 5, json::object(), Precision::double_precision).hash);
}

TEST(SimulationTest, WithoutAGaitTheMusclesRest) {
    Simulation<float> simulation(SimulationSetup{.scene = in_vacuum});
    EXPECT_EQ(simulation.gait().amplitude, (std::vector<double>{0, 0}));
    const State<float> start = simulation.state();
    EXPECT_NE(hash_after(simulation, 3), evaluated(in_vacuum, 3).hash);
    EXPECT_EQ(simulation.state().spring_rest_length, start.spring_rest_length);
}

TEST(SimulationTest, AGaitActsFromTheNextFrameOn) {
    Simulation<float> simulation = swimmer(in_vacuum), unchanged = swimmer(in_vacuum);
    const std::uint64_t before = hash_after(simulation, 4);
    Gait slower = swimming;
    slower.frequency = 0.7;
    simulation.set_gait(slower);
    EXPECT_EQ(state_hash(simulation.state()), before);
    EXPECT_EQ(simulation.gait().frequency, 0.7);
    EXPECT_NE(hash_after(simulation, 5), hash_after(unchanged, 5));
    EXPECT_EQ(simulation.frames(), 5);
}

TEST(SimulationTest, OverridesThatChangeNothingChangeNoBit) {
    Simulation<float> simulation = swimmer(in_water, hardly_settled);
    const double viscosity = simulation.scene().solver.flex.viscosity;
    for (int frames = 0; frames < 6; frames += 2) {
        hash_after(simulation, frames);
        EXPECT_FALSE(merge(simulation, {{"solver", {{"viscosity", viscosity}}}, {"duration", 9}}));
        EXPECT_EQ(simulation.frames(), frames);
    }
    EXPECT_EQ(hash_after(simulation, 6), evaluated(in_water, 6, hardly_settled).hash);
    EXPECT_EQ(simulation.scene().duration, 9);
}

TEST(SimulationTest, SettingsMassesAndPlanesGoOnFromThePresentState) {
    const json masses{{"creature", {{"particleMass", 3}}}, {"fluid", {{"mass", {{"bottom", 5}}}}}};
    const std::vector<json> patches{{{"solver", {{"viscosity", 9}}}},
                                    {{"solver", {{"substeps", 2}, {"numIterations", 6}}}},
                                    {{"solver", {{"gravity", {0, -3, 0}}, {"radius", 0.16}}}},
                                    {{"planes", json::array({{0, 1, 0, 0}})}},
                                    {{"creature", {{"clusterStiffness", 0.3}}}},
                                    masses};
    Simulation<float> unchanged = swimmer(in_water, hardly_settled);
    const std::uint64_t before = hash_after(unchanged, 3), after = hash_after(unchanged, 4);
    for (const json& patch : patches) {
        Simulation<float> simulation = swimmer(in_water, hardly_settled);
        hash_after(simulation, 3);
        EXPECT_FALSE(merge(simulation, patch)) << patch;
        EXPECT_EQ(state_hash(simulation.state()), before) << patch;
        EXPECT_NE(hash_after(simulation, 4), after) << patch;
        EXPECT_NEAR(simulation.state().time, 4.0 / 60, 1e-12);
    }
}

TEST(SimulationTest, OtherParticlesOrConstraintsStartAnew) {
    const std::vector<json> patches{{{"fluid", {{"count", {17, 6, 9}}}}},
                                    {{"fluid", {{"origin", {0.051, 0.05, 0.05}}}}},
                                    {{"fluid", nullptr}},
                                    {{"creature", {{"spacing", 0.07}}}},
                                    {{"creature", {{"rearCentre", {0.5, 0.42, 0.41}}}}},
                                    {{"creature", {{"springsPerParticle", 3}}}},
                                    {{"scheme", "conserving"}}};  // whose water starts in disorder
    for (const json& patch : patches) {
        Simulation<float> simulation = swimmer(in_water);
        hash_after(simulation, 2);
        EXPECT_TRUE(merge(simulation, patch)) << patch;
        EXPECT_EQ(simulation.frames(), 0);
        EXPECT_EQ(hash_after(simulation, 3), evaluated(in_water, 3, patch).hash) << patch;
    }
}

TEST(SimulationTest, TimeGoesOnUnderAnotherTimeStep) {
    Simulation<float> simulation = swimmer(in_vacuum);
    hash_after(simulation, 6);
    EXPECT_FALSE(merge(simulation, {{"timeStep", 0.01}}));
    hash_after(simulation, 9);
    EXPECT_NEAR(simulation.state().time, 0.1 + 0.03, 1e-12);
    EXPECT_FALSE(merge(simulation, {{"timeStep", 0.02}}));
    hash_after(simulation, 10);
    EXPECT_NEAR(simulation.state().time, 0.1 + 0.03 + 0.02, 1e-12);
    simulation.reset();
    hash_after(simulation, 2);
    EXPECT_EQ(simulation.state().time, 0.04);
}

TEST(SimulationTest, ResetGivesTheSameBitsAgain) {
    Simulation<float> simulation = swimmer(in_water);
    const std::uint64_t start = state_hash(simulation.state()), later = hash_after(simulation, 5);
    simulation.reset();
    EXPECT_EQ(simulation.frames(), 0);
    EXPECT_EQ(simulation.distance(), 0);
    EXPECT_EQ(state_hash(simulation.state()), start);
    EXPECT_EQ(hash_after(simulation, 5), later);
}

TEST(SimulationTest, AnotherSceneStartsWithItsOwnSettings) {
    Simulation<float> simulation = swimmer(in_water, {{"solver", {{"viscosity", 9}}}});
    hash_after(simulation, 2);
    simulation.load({in_vacuum, {}, swimming});
    EXPECT_EQ(simulation.setup().scene, in_vacuum);
    EXPECT_EQ(simulation.setup().overrides, "");
    EXPECT_EQ(hash_after(simulation, 4), evaluated(in_vacuum, 4).hash);
}

TEST(SimulationTest, MergedOverridesLoadAgain) {
    Simulation<float> simulation = swimmer(in_water, {{"solver", {{"viscosity", 9}}}});
    EXPECT_TRUE(merge(simulation, {{"fluid", nullptr}}));
    EXPECT_FALSE(merge(simulation, {{"solver", {{"damping", 2}}}}));
    const json expected{{"fluid", nullptr}, {"solver", {{"viscosity", 9}, {"damping", 2}}}};
    EXPECT_EQ(json::parse(simulation.setup().overrides), expected);
    EXPECT_EQ(simulation.model().particles(), 81);
    Simulation<float> again(simulation.setup());
    EXPECT_EQ(hash_after(again, 2), evaluated(in_water, 2, expected).hash);
}

TEST(SimulationTest, WhatIsRefusedChangesNothing) {
    Simulation<float> simulation = swimmer(in_vacuum);
    hash_after(simulation, 3);
    const SimulationSetup setup = simulation.setup();
    Gait wrong = swimming;
    wrong.amplitude.push_back(0.5);
    EXPECT_THROW(simulation.set_gait(wrong), InputError);
    EXPECT_THROW(merge(simulation, {{"solver", {{"substeps", 0}}}}), InputError);
    EXPECT_THROW(merge(simulation, {{"fluids", 1}}), InputError);
    EXPECT_THROW(merge(simulation, {{"planes", json::array({{0, 1, 0, -5}})}}), InputError);  // body beyond it
    EXPECT_THROW(merge(simulation, {{"creature", {{"name", "creature-2"}}}}), InputError);    // 8 actuators
    EXPECT_THROW(simulation.load({.scene = "thesis/nothing"}), InputError);
    EXPECT_THROW(simulation.load({"thesis/creature-2", {}, swimming}), InputError);
    EXPECT_EQ(simulation.frames(), 3);
    EXPECT_EQ(simulation.setup().scene, setup.scene);
    EXPECT_EQ(simulation.setup().overrides, setup.overrides);
    EXPECT_EQ(hash_after(simulation, 5), evaluated(in_vacuum, 5).hash);
    EXPECT_THROW(Simulation<float>({"thesis/creature-2", {}, swimming}), InputError);
}

/// Undivided global relaxation explodes at once in water.
TEST(SimulationTest, AnUnstableSimulationStandsStillUntilItStartsAnew) {
    const json unstable{{"solver", {{"relaxationMode", "global"}}}}, stable{{"solver", {{"relaxationMode", "local"}}}};
    Simulation<float> simulation = swimmer(in_water);
    hash_after(simulation, 2);
    EXPECT_FALSE(merge(simulation, unstable));
    while (simulation.step()) ASSERT_LT(simulation.frames(), 100);
    ASSERT_TRUE(simulation.instability());
    EXPECT_FALSE(simulation.instability()->stage.empty());
    const std::uint64_t broken = state_hash(simulation.state());
    EXPECT_FALSE(simulation.step());
    EXPECT_EQ(state_hash(simulation.state()), broken);
    simulation.reset();
    EXPECT_TRUE(simulation.instability());  // while settling
    EXPECT_FALSE(simulation.step());
    EXPECT_TRUE(merge(simulation, stable));
    EXPECT_FALSE(simulation.instability());
    EXPECT_EQ(hash_after(simulation, 2), evaluated(in_water, 2).hash);
}

/// One iteration of a hundredth of what it should push, against a strong pull.
TEST(SimulationTest, WaterThatIsCompressedEndsAStreamAsItEndsAnEvaluation) {
    const json crushed{
        {"settling", {{"updates", 0}}},
        {"solver", {{"numIterations", 1}, {"substeps", 16}, {"relaxationFactor", 0.01}, {"gravity", {0, -100, 0}}}}};
    const Evaluation evaluation = evaluated(in_water, 32, crushed);
    ASSERT_TRUE(evaluation.instability);
    EXPECT_EQ(evaluation.instability->law, "compression");
    Simulation<float> simulation = swimmer(in_water, crushed);
    while (simulation.step()) ASSERT_LT(simulation.frames(), 32);
    EXPECT_EQ(simulation.instability()->law, "compression");
}

/// Each as by itself, in any company; what is unstable stands still.
TEST(SimulationTest, SeveralGoOnTogether) {
    const json falling{{"settling", {{"updates", 0}}}, {"solver", {{"gravity", {0, -1000, 0}}, {"maxSpeed", 1e9}}}};
    std::vector<Simulation<float>> alone, together;
    for (auto* swims : {&alone, &together}) {
        swims->push_back(swimmer(in_water, hardly_settled));
        swims->push_back(swimmer(in_water, falling));
        swims->push_back(swimmer(in_vacuum));
        swims->back().drive({0.5, -0.5});
    }
    std::vector<bool> stable;
    for (int frame = 0; frame < 4; ++frame) {
        for (Simulation<float>& swim : alone) swim.step();
        stable = step_together<float>({&together[0], &together[1], &together[2]}, 2);
    }
    EXPECT_EQ(stable, (std::vector<bool>{true, false, true}));
    for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_EQ(together[k].frames(), alone[k].frames()) << k;
        EXPECT_EQ(state_hash(together[k].state()), state_hash(alone[k].state())) << k;
    }
}

/// The densities of a state are the same whether or not an update has just led to it, but for pairs that come to less
/// than the radius within a substep: they weigh (1 - r/R)^2, next to nothing.
TEST(SimulationTest, DensitiesOfAStateNeedNoUpdate) {
    for (const char* scheme : {"flex", "conserving"}) {
        Simulation<float> simulation = swimmer(in_water, {{"scheme", scheme}});
        hash_after(simulation, 5);
        const std::vector<float> updated = simulation.densities();
        ASSERT_FALSE(merge(simulation, json::object()));
        const std::uint64_t before = state_hash(simulation.state());
        const std::vector<float> fresh = simulation.densities();
        EXPECT_EQ(state_hash(simulation.state()), before);
        ASSERT_EQ(fresh.size(), updated.size());
        double largest = 0, sum = 0;
        for (std::size_t i = 0; i < fresh.size(); ++i) {
            largest = std::max(largest, std::abs(static_cast<double>(fresh[i]) - updated[i]));
            sum += fresh[i];
        }
        EXPECT_LT(largest, 1e-2) << scheme;
        EXPECT_GT(sum / 857, 0.5) << scheme;
    }
}

}  // namespace
}  // namespace natator
