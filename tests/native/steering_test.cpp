// A gait that is steered, and actuators that a program drives itself.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "natator/evaluate.h"
#include "natator/gait.h"
#include "natator/load_scene.h"
#include "natator/measure.h"
#include "natator/model.h"
#include "natator/simulation.h"
#include "refusal_of.h"

namespace natator {
namespace {

const Gait steered_gait{1.861, {0.973, 0.690}, {0, 0.648}};
const std::string steered_water = "bench/small-tank", steered_vacuum = "thesis/creature-1-vacuum";
const std::string short_conserving = R"({"duration":0.1,"scheme":"conserving","settling":{"updates":5}})";
const std::string in_conserving = R"({"scheme":"conserving","settling":{"updates":5}})";

std::uint64_t run_to(Simulation<float>& simulation, int frames) {
    while (simulation.frames() < frames) EXPECT_TRUE(simulation.step());
    return state_hash(simulation.state());
}

Simulation<float> by_gait_in(const std::string& scene, const std::string& overrides = "") {
    return Simulation<float>({.scene = scene, .overrides = overrides, .gait = steered_gait});
}

TEST(SteeringTest, NoSteeringChangesNoBit) {
    for (const std::string& overrides : {std::string(), in_conserving}) {
        Simulation<float> plain = by_gait_in(steered_water, overrides), steered = by_gait_in(steered_water, overrides);
        for (int frames = 1; frames <= 6; ++frames) {
            steered.steer(no_steering(2));
            EXPECT_EQ(run_to(steered, frames), run_to(plain, frames)) << overrides;
        }
    }
}

/// In scheme `flex` a frame has the muscles that the gait gives at its start: a program can do what the gait does.
TEST(SteeringTest, AGaitsOwnValuesGiveItsBits) {
    Simulation<float> by_gait = by_gait_in(steered_vacuum), by_values(SimulationSetup{.scene = steered_vacuum});
    while (by_values.frames() < 30) {
        by_values.drive(drive(by_values.model(), steered_gait, by_values.state().time));
        ASSERT_TRUE(by_values.step());
    }
    EXPECT_EQ(run_to(by_gait, 30), state_hash(by_values.state()));
    EXPECT_NE(by_gait.distance(), 0);
}

TEST(SteeringTest, MusclesHaveTheLengthsOfTheValuesAtTheEndOfTheFrame) {
    for (const std::string& overrides : {std::string(), in_conserving}) {
        Simulation<float> simulation = by_gait_in(steered_water, overrides);
        run_to(simulation, 2);
        simulation.drive({0.5, -1.25});
        EXPECT_NE(simulation.driven(), (std::vector<double>{0.5, -1.25}));  // from the next frame on
        ASSERT_TRUE(simulation.step());
        EXPECT_EQ(simulation.driven(), (std::vector<double>{0.5, -1.25}));
        for (const Muscle& muscle : simulation.model().muscles) {
            const double value = muscle.actuator == 0 ? 0.5 : -1.25;
            const double length = simulation.model().springs[muscle.spring].rest_length;
            EXPECT_NEAR(simulation.state().spring_rest_length[muscle.spring],
                        length * (1 + 0.5 * muscle.lateral * value), 1e-6);
        }
        run_to(simulation, 5);
        EXPECT_EQ(simulation.driven(), (std::vector<double>{0.5, -1.25}));  // until told otherwise
    }
}

TEST(SteeringTest, AFrameGoesStraightFromOneSteeringToTheNext) {
    const Steering from{{1, 0}, {0.25, 0}}, to{{0, 0}, {0.75, -1}};
    EXPECT_EQ(steer(from, to, 0, {0.5, 0.5}), (std::vector<double>{0.75, 0}));
    EXPECT_EQ(steer(from, to, 0.5, {0.5, 0.5}), (std::vector<double>{0.75, -0.5}));
    EXPECT_EQ(steer(from, to, 1, {0.5, 0.5}), (std::vector<double>{0.75, -1}));
}

TEST(SteeringTest, ASolverAsksForTheStartOfAFrameOrTheEndsOfItsSubsteps) {
    for (const char* scheme : {"flex", "conserving"}) {
        const Scene scene = load_scene(
            steered_vacuum, SceneOptions{std::string(R"({"solver":{"substeps":4},"scheme":")") + scheme + R"("})"});
        const Model model = build_model(scene);
        Solver<double> solver(model);
        State<double> state = initial_state<double>(model);
        state.time = 1;
        std::vector<double> times;
        ASSERT_FALSE(solver.frame(state, [&times](double time) {
            times.push_back(time);
            return std::vector<double>{0.1, 0.2};
        }));
        if (scene.scheme == Scheme::flex) {
            EXPECT_EQ(times, std::vector<double>{1});
        } else {
            ASSERT_EQ(times.size(), 4u);
            for (int k = 0; k < 4; ++k) EXPECT_NEAR(times[k], 1 + (k + 1) / 240.0, 1e-12);
        }
    }
}

/// Mean z of a slice.
double mean_z(const Simulation<float>& simulation, std::size_t slice) {
    double sum = 0;
    const std::vector<int>& particles = simulation.model().body.slices[slice];
    for (const int particle : particles) sum += simulation.state().position[particle].z();
    return sum / static_cast<double>(particles.size());
}

TEST(SteeringTest, AnOffsetBendsTheBodyToItsSide) {
    for (const double side : {1.0, -1.0}) {
        Simulation<float> simulation(SimulationSetup{.scene = steered_vacuum});
        simulation.steer({{1, 1}, {0.4 * side, 0.4 * side}});
        run_to(simulation, 30);
        const std::size_t last = simulation.model().body.slices.size() - 1;
        const double ends = (mean_z(simulation, 0) + mean_z(simulation, last)) / 2;
        EXPECT_LT(side * (ends - mean_z(simulation, last / 2)), -0.02);  // +z is the right
    }
}

TEST(SteeringTest, AScaleIsAnotherAmplitude) {
    Simulation<float> halved = by_gait_in(steered_vacuum),
                      weaker(SimulationSetup{.scene = steered_vacuum,
                                             .gait = Gait{1.861, {0.973 / 2, 0.690 / 2}, {0, 0.648}}});
    halved.steer({{0.5, 0.5}, {0, 0}});
    EXPECT_EQ(run_to(halved, 20), run_to(weaker, 20));
}

TEST(SteeringTest, EachStartBeginsWithoutSteering) {
    Simulation<float> simulation = by_gait_in(steered_water);
    const std::uint64_t expected = run_to(simulation, 4);
    for (int way = 0; way < 3; ++way) {
        simulation.drive({1, -1});
        ASSERT_TRUE(simulation.step());
        if (way == 0) simulation.reset();
        if (way == 1) simulation.load({.scene = steered_water, .gait = steered_gait});
        if (way == 2) simulation.merge_overrides(R"({"fluid":{"count":[17,6,9]}})");
        EXPECT_TRUE(leaves_gait(simulation.steering()));
        EXPECT_EQ(run_to(simulation, 4) == expected, way < 2);
    }
}

TEST(SteeringTest, WhatCannotBeIsRefusedAndChangesNothing) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    Simulation<float> simulation = by_gait_in(steered_vacuum), other = by_gait_in(steered_vacuum);
    simulation.drive({0.5, 0.5});
    other.drive({0.5, 0.5});
    EXPECT_EQ(test::refusal_of([&] { simulation.drive({1}); }),
              "drive has length 1: must have length 2, one value per actuator of the creature");
    EXPECT_EQ(test::refusal_of([&] { simulation.drive({1, none}); }), "drive[1] = NaN: must be a number in [-2, 2]");
    EXPECT_EQ(test::refusal_of([&] { simulation.drive({2.5, 0}); }), "drive[0] = 2.5: must be a number in [-2, 2]");
    EXPECT_EQ(test::refusal_of([&] { simulation.steer({{1, -1}, {0, 0}}); }),
              "scale[1] = -1: must be a number in [0, 4]");
    EXPECT_EQ(test::refusal_of([&] { simulation.steer({{1, 1}, {0, none}}); }),
              "offset[1] = NaN: must be a number in [-2, 2]");
    EXPECT_EQ(test::refusal_of([&] { simulation.steer({{1, 1}, {}}); }),
              "offset has length 0: must have length 2, one value per actuator of the creature");
    EXPECT_EQ(test::refusal_of([&] { simulation.steer({{2, 1}, {0.5, 0}}); }),
              "scale[0] = 2 and offset[0] = 0.5: scale times the gait's own largest drive, 0.973, plus |offset| must "
              "be at most "
              "2, is 2.446 (a muscle has no length below 0)");
    EXPECT_EQ(run_to(simulation, 3), run_to(other, 3));
    Gait bent = steered_gait;
    bent.offset = {0.9, 0};
    EXPECT_NE(test::refusal_of([&] { check_steering({{1, 1}, {0.2, 0}}, bent, 2); }).find("drive, 1.873, plus"),
              std::string::npos);

    simulation.steer({{2, 2}, {0, 0}});
    Gait stronger = steered_gait;
    stronger.amplitude[0] = 1.5;
    EXPECT_NE(test::refusal_of([&] { simulation.set_gait(stronger); }).find("scale[0] = 2 and offset[0] = 0"),
              std::string::npos);
    EXPECT_EQ(simulation.gait().amplitude[0], steered_gait.amplitude[0]);
    EXPECT_EQ(test::refusal_of([] { Simulation<float>(SimulationSetup{.scene = "thesis/tank"}).drive({1}); }),
              "drive has length 1: must have length 0, one value per actuator of the creature (there is none)");
}

TEST(SteeringTest, StartsAreThoseOfEvaluations) {
    for (const std::string& overrides : {std::string(R"({"duration":0.1})"), short_conserving}) {
        Scene scene = load_scene(steered_water, SceneOptions{overrides});
        scene.stopping = {false, 0};
        const Perturbation shift = choose_start(7, scene);
        const std::uint64_t expected = evaluate(scene, steered_gait, {.perturbation = shift}).hash;
        Simulation<float> begun({.scene = steered_water, .overrides = overrides, .gait = steered_gait, .start = 7});
        Simulation<float> reset = by_gait_in(steered_water, overrides);
        const std::uint64_t own = run_to(reset, 6);
        reset.reset(7);
        EXPECT_EQ(reset.frames(), 0);
        EXPECT_EQ(reset.setup().start, 7);
        EXPECT_EQ(run_to(begun, 6), expected) << overrides;
        EXPECT_EQ(run_to(reset, 6), expected) << overrides;
        EXPECT_NE(own, expected);
        reset.reset();  // keeps it
        EXPECT_EQ(run_to(reset, 6), expected) << overrides;
    }
}

TEST(SteeringTest, MuscleWorkIsThatSinceTheStart) {
    Scene scene = load_scene(steered_water, SceneOptions{short_conserving});
    scene.stopping = {false, 0};
    const double expected = evaluate(scene, steered_gait).work.value();
    Simulation<float> simulation = by_gait_in(steered_water, short_conserving);
    for (int turn = 0; turn < 3; ++turn) {
        EXPECT_EQ(simulation.muscle_work(), 0);
        run_to(simulation, 6);
        EXPECT_EQ(simulation.muscle_work(), expected) << turn;  // to the bit, in each turn
        simulation.reset();
    }
    run_to(simulation, 3);
    EXPECT_FALSE(simulation.merge_overrides("{}"));  // a solver of its own goes on
    run_to(simulation, 6);
    EXPECT_NEAR(simulation.muscle_work(), expected, 1e-9 * std::abs(expected));
    EXPECT_NE(expected, 0);
}

}  // namespace
}  // namespace natator
