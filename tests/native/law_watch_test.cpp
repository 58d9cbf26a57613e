// What a run must not come to: each law by itself on States made for it, and on scenes that break it.
#include <gtest/gtest.h>

#include <cmath>

#include "law_models.h"
#include "natator/evaluate.h"
#include "natator/model.h"
#include "natator/simulation.h"
#include "physics/laws.h"
#include "run/laws.h"
#include "run/settle.h"
#include "scene/scene_json.h"

namespace natator {
namespace {

using nlohmann::json;

const Gait resting_short_swimmer{1, {0, 0}, {0, 0}, 1};

/// The short swimmer's tank, and its start.
struct LawWatchTest : testing::Test {
    LawWatchTest() { state = initial_state<double>(model); }

    std::string broken(double work = 0) {
        LawWatch laws(model);
        const State<double> start = initial_state<double>(model);
        EXPECT_FALSE(laws.start(measure_laws(model, start)));
        const auto found = laws.look(measure_laws(model, state), work, 0.5);
        if (!found) return "";
        EXPECT_EQ(found->stage, "frame");
        EXPECT_EQ(found->time, 0.5);
        particle = found->particle;
        return found->law;
    }

    Scene scene = load_scene("bench/small-tank", json{{"scheme", "conserving"}});
    Model model = build_model(scene);
    State<double> state;
    int particle = -1;
};

TEST_F(LawWatchTest, AStartBreaksNone) {
    EXPECT_EQ(broken(), "");
}

TEST_F(LawWatchTest, NobodyIsBehindAPlane) {
    state.position[900].x() = -0.9 * model.parameters.radius;
    EXPECT_EQ(broken(), "");
    state.position[900].x() = -1.1 * model.parameters.radius;
    EXPECT_EQ(broken(), "tank");
    EXPECT_EQ(particle, 900);
}

/// The tank is 0.6 deep: what falls has 3.5, and 3 times that is spray, but not 10 times; nor is it 20 high.
TEST_F(LawWatchTest, NoParticleHasMoreEnergyThanGravityGives) {
    state.velocity[500].y() = 8;
    EXPECT_EQ(broken(), "");
    state.velocity[500].y() = 35;
    EXPECT_EQ(broken(), "particle-energy");
    EXPECT_EQ(particle, 500);
    state = initial_state<double>(model);
    state.position[501].y() = 20;
    EXPECT_EQ(broken(), "particle-energy");
    EXPECT_EQ(particle, 501);
}

/// A small amplitude bends a slender body so far that its tail goes as fast as that of a beat of its length.
TEST(LawsOfABodyOnALattice, LetASlenderTailWhip) {
    const Model loach = build_model(load_scene("plane/loach", json::object()));
    LawWatch laws(loach);
    laws.drive_by({2, {0.1, 0.1, 0.1, 0.1}, {0, 0, 0, 0}});
    physics::LawMeasures measures;
    measures.most_energetic = 0;
    const double beat = 2 * 3.14159 * 2 * loach.body.length;
    measures.particle_energy = std::pow(0.9 * beat, 2) / 2;
    EXPECT_FALSE(laws.look(measures, 0, 0.5));
    measures.particle_energy = std::pow(1.1 * beat, 2) / 2;
    EXPECT_TRUE(laws.look(measures, 0, 0.5));
}

/// It may have what its muscles gave it before the tank moved, and no more.
TEST(LawsOfABodyOnALattice, KeepItsWorkWhereItsTankMoves) {
    LawWatch laws(build_model(load_scene("plane/loach", json::object())));
    physics::LawMeasures measures;
    laws.start(measures);
    laws.restart();
    measures.energy = 100;
    EXPECT_FALSE(laws.look(measures, 2000, 0.2));
    measures.energy = 1000;
    EXPECT_FALSE(laws.look(measures, 1900, 0.3));
    measures.energy = 3000;
    EXPECT_TRUE(laws.look(measures, 2000, 0.4));
}

/// All the water at a speed that one particle may have.
TEST_F(LawWatchTest, AllTogetherHaveNoMoreThanAtTheStartAndByTheMuscles) {
    for (auto& v : state.velocity) v.x() = 5;
    EXPECT_EQ(broken(), "energy");
    EXPECT_EQ(broken(12.5 * 1e3), "");
}

TEST_F(LawWatchTest, NoBodyIsStretchedToSeveralTimesItsLength) {
    const int tail = model.body.particles.back();
    model.planes.clear();
    state.position[tail].x() -= 1.5 * model.body.length;
    EXPECT_EQ(broken(), "");
    state.position[tail].x() -= 1.5 * model.body.length;
    EXPECT_EQ(broken(), "shape");
    EXPECT_EQ(particle, tail);
}

TEST_F(LawWatchTest, NoFluidIsCompressedToAFraction) {
    EXPECT_FALSE(broken_by_compression(0.1, 1));
    ASSERT_TRUE(broken_by_compression(0.6, 1));
    EXPECT_EQ(broken_by_compression(0.6, 1)->law, "compression");
}

/// Margins say how near a run has come: half a radius behind a plane is half of the way.
TEST_F(LawWatchTest, TellsThePartsThatARunHasUsed) {
    LawWatch laws(model);
    laws.start(measure_laws(model, state));
    state.position[900].x() = -0.5 * model.parameters.radius;
    EXPECT_FALSE(laws.look(measure_laws(model, state), 0, 0.5));
    EXPECT_NEAR(laws.margins().depth, 0.5, 1e-12);
    EXPECT_NEAR(laws.margins().reach, 1.0 / 3, 0.05);
    EXPECT_EQ(laws.margins().largest(), laws.margins().depth);
}

struct BrokenScene {
    const char* name;
    const char* overrides;
    const char* law;
    const char* stage;
};

class BrokenLaws : public testing::TestWithParam<BrokenScene> {};

/// In an evaluation, in float and double, and in a scene that is watched.
TEST_P(BrokenLaws, EndARunAsUnstable) {
    const Scene scene = load_scene("bench/small-tank", json::parse(GetParam().overrides));
    for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
        const Evaluation result = evaluate(scene, resting_short_swimmer, {.precision = precision});
        EXPECT_EQ(result.stopped, StopReason::unstable);
        EXPECT_EQ(result.fitness(), 0);
        ASSERT_TRUE(result.instability);
        EXPECT_EQ(result.instability->law, GetParam().law);
        EXPECT_EQ(result.instability->stage, GetParam().stage);
    }
    Simulation<float> live(
        {.scene = "bench/small-tank", .overrides = GetParam().overrides, .gait = resting_short_swimmer});
    for (int frame = 0; frame < 60 && live.step(); ++frame) continue;
    ASSERT_TRUE(live.instability());
    EXPECT_EQ(live.instability()->law, GetParam().law);
    EXPECT_FALSE(live.step());
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, BrokenLaws,
    testing::Values(
        BrokenScene{"LightWater", R"({"fluid": {"mass": {"bottom": 0.02}}, "stopping": {"planeContact": false}})",
                    "tank", "frame"},
        BrokenScene{"WideContacts", R"({"solver": {"collisionDistance": 1000}, "stopping": {"planeContact": false}})",
                    "tank", "settling"},
        BrokenScene{"StrongTension", R"({"scheme": "conserving", "solver": {"surfaceTension": 100}})", "energy",
                    "frame"},
        BrokenScene{
            "UnequalMasses",
            R"({"scheme": "conserving", "fluid": {"mass": {"gradient": "mass-linear", "bottom": 0.001, "top": 1000}}})",
            "particle-energy", "frame"}),
    [](const auto& test) { return std::string(test.param.name); });

/// What falls without an end keeps the laws, at whatever speed; so does water that gravity drives round a periodic
/// tank.
TEST(LawsOfMotion, AreKeptByWhatFallsForEver) {
    const json drop = {
        {"scheme", "conserving"},
        {"duration", 4},
        {"settling", {{"updates", 0}}},
        {"fluid", {{"count", {3, 3, 3}}, {"spacing", 0.1}, {"mass", {{"gradient", "uniform"}, {"bottom", 1}}}}},
        {"solver", {{"damping", 0}}}};
    for (const char* scheme : {"flex", "conserving"}) {
        json own = drop;
        own["scheme"] = scheme;
        EXPECT_EQ(evaluate(scene_from_json(own, "drop"), {}).stopped, StopReason::completed) << scheme;
    }
    json channel = drop;
    channel.merge_patch(json::parse(
        R"({"periodic": ["x"], "planes": [[0,1,0,0],[0,-1,0,0.4],[0,0,1,0],[0,0,-1,0.4],[1,0,0,0],[-1,0,0,0.6]],
        "fluid": {"count": [6,4,4], "origin": [0.05,0.05,0.05]}, "solver": {"gravity": [10,0,0]}})"));
    EXPECT_EQ(evaluate(scene_from_json(channel, "channel"), {}).stopped, StopReason::completed);
}

/// Settings changed on the way are no explosion: gravity goes, and the water still has the speed that it had.
TEST(LawsOfMotion, GoOnFromWhatASceneHadBecome) {
    Simulation<float> live({.scene = "bench/small-tank", .overrides = R"({"scheme": "conserving", "creature": null})"});
    for (int frame = 0; frame < 10; ++frame) ASSERT_TRUE(live.step());
    EXPECT_FALSE(live.merge_overrides(R"({"solver": {"gravity": [0, 0, 0]}})"));
    for (int frame = 0; frame < 30; ++frame) ASSERT_TRUE(live.step()) << sentence_of(*live.instability());
}

/// A crowded start that has not settled comes apart: it rises, and is no explosion.
TEST(LawsOfMotion, AreKeptByAStartThatIsCrowded) {
    for (const int iterations : {4, 128}) {
        const Scene scene = load_scene("bench/small-tank", json{{"scheme", "conserving"},
                                                                {"duration", 0.2},
                                                                {"settling", {{"updates", 0}}},
                                                                {"solver", {{"numIterations", iterations}}}});
        EXPECT_EQ(evaluate(scene, resting_short_swimmer).stopped, StopReason::completed) << iterations;
    }
}

/// Who beats beside the swimmer may be as fast as his own gait makes him.
TEST(LawsOfMotion, AreKeptByCompanions) {
    const json body = {{"slices", {{{"height", 3}, {"width", 3}, {"count", 9}}}},
                       {"joints", {2, 4, 6}},
                       {"rearCentre", {0.4, 0.4, 1.2}}};
    const json gait = {{"frequency", 30}, {"amplitude", {2, 2}}, {"phase", {0, 0.5}}};
    const Scene scene =
        load_scene("bench/small-tank",
                   json{{"scheme", "conserving"},
                        {"duration", 0.5},
                        {"stopping", {{"planeContact", false}}},
                        {"planes", {{0, 1, 0, 0}, {0, 0, 1, 0}, {1, 0, 0, 0}, {-1, 0, 0, 1.54}, {0, 0, -1, 1.72}}},
                        {"fluid", {{"count", {17, 7, 19}}}},
                        {"companions", {{{"creature", body}, {"gait", gait}}}}});
    EXPECT_EQ(evaluate(scene, resting_short_swimmer).stopped, StopReason::completed);
}

}  // namespace
}  // namespace natator
