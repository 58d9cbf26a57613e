// The activation (thesis 2.6 and 4.2) and the muscle lengths it gives (2.7, 2.8), against numbers worked out by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "natator/error.h"
#include "natator/gait.h"
#include "natator/model.h"
#include "scene/scene_json.h"

namespace natator {
namespace {

TEST(GaitTest, ActivationIsASineOfTimeAndPhase) {
    const Gait gait{0.5, {1, 1}, {0, 0.25}, 1};
    EXPECT_NEAR(activation(gait, 0, 0), 0, 1e-15);
    EXPECT_NEAR(activation(gait, 0, 0.5), 1, 1e-15);  // a quarter of the period of 2 s
    EXPECT_NEAR(activation(gait, 0, 1.5), -1, 1e-15);
    EXPECT_NEAR(activation(gait, 0, 1.0 / 6), 0.5, 1e-15);  // sin 30 degrees
    EXPECT_NEAR(activation(gait, 1, 0), 1, 1e-15);
    EXPECT_NEAR(activation(gait, 1, 1.0 / 3), 0.5, 1e-15);  // sin 150 degrees
}

TEST(GaitTest, PowerRaisesTheActivationShiftedToZeroToOne) {
    const Gait gait{1, {1}, {0}, 4};
    EXPECT_NEAR(activation(gait, 0, 0), 2.0 / 16 - 1, 1e-15);  // (1/2)^4 * 2 - 1
    EXPECT_NEAR(activation(gait, 0, 0.25), 1, 1e-15);
    EXPECT_NEAR(activation(gait, 0, 0.75), -1, 1e-15);
    const Gait root{1, {1}, {0}, 0.5};
    EXPECT_NEAR(activation(root, 0, 0), 0.414213562373095, 1e-14);  // sqrt(1/2) * 2 - 1
}

TEST(GaitTest, AWaveGrowsTowardsTheTailAndRunsThere) {
    const Creature creature = *load_scene("open-water/creature-2").creature;
    const Gait gait = wave_gait(creature);
    EXPECT_EQ(gait.frequency, 2);
    EXPECT_EQ(gait.amplitude, (std::vector<double>{0.07, 0.12, 0.17, 0.22, 0.28, 0.33, 0.38, 0.43}));
    EXPECT_EQ(gait.phase,
              (std::vector<double>{0, 0.95, 0.89, 0.84, 0.79, 0.74, 0.68, 0.63}));  // half a wave on 19 slices
    EXPECT_NO_THROW(check_gait(gait, creature.actuators()));
}

TEST(GaitTest, AWaveBendsTheBodyOneWay) {
    const auto gait_of = [](const char* bend) {
        return wave_gait(*load_scene("open-water/ray", nlohmann::json::parse(bend)).creature);
    };
    const Gait vertical = gait_of("{}"), both = gait_of(R"({"creature":{"bend":"both"}})");
    ASSERT_EQ(both.amplitude.size(), 10u);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(both.amplitude[i], vertical.amplitude[i]);
        EXPECT_EQ(both.amplitude[i + 5], 0);
    }
    EXPECT_LE(gait_of(R"({"creature":{"bend":["both","vertical","vertical","vertical","vertical"]}})").amplitude[0], 1);
}

/// Numbers recorded with NVIDIA Flex for creature 1 at time 0: actuator 1 has phase 0.648 and amplitude 0.69.
TEST(GaitTest, MuscleLengthsOfCreatureOneAreTheRecordedOnes) {
    const Model model = build_model(load_scene("thesis/creature-1"));
    State<float> state = initial_state<float>(model);
    actuate(model, Gait{1.861, {0.973, 0.69}, {0, 0.648}, 1}, 0, state);
    for (const Muscle& muscle : model.muscles) {
        const float length = state.spring_rest_length[muscle.spring];
        if (muscle.actuator == 0) {
            EXPECT_FLOAT_EQ(length, 0.3f);
        } else {
            EXPECT_NEAR(length, muscle.lateral < 0 ? 0.3829622 : 0.21703781, 2e-7);
        }
    }
}

/// At u > 0 right muscles stretch and left ones shorten: by half the amplitude at the edges.
TEST(GaitTest, RightMusclesStretchWhenTheActivationIsPositive) {
    const Model model = build_model(load_scene("thesis/creature-1"));
    State<double> state = initial_state<double>(model);
    actuate(model, Gait{1, {0.4, 0}, {0.25, 0}, 1}, 0, state);
    for (const Muscle& muscle : model.muscles) {
        const double expected = muscle.actuator == 1 ? 0.3 : muscle.lateral > 0 ? 0.36 : 0.24;
        EXPECT_NEAR(state.spring_rest_length[muscle.spring], expected, 1e-12);
    }
}

/// Scheme conserving starts its muscles softly: smoothstep of t / 0.25 s, 1/2 at half of that.
TEST(GaitTest, DriveIsAmplitudeTimesActivation) {
    Model model = build_model(load_scene("thesis/creature-1"));
    const Gait gait{1, {0.4, 0.5}, {0.25, 0.125}, 1};  // at 0.125 s: sin 135 and sin 90 degrees
    for (const Scheme scheme : {Scheme::flex, Scheme::conserving}) {
        model.scheme = scheme;
        const double ramp = scheme == Scheme::conserving ? 0.5 : 1;
        const std::vector<double> driven = drive(model, gait, 0.125);
        ASSERT_EQ(driven.size(), 2u);
        EXPECT_NEAR(driven[0], ramp * 0.4 * std::sqrt(0.5), 1e-15);
        EXPECT_NEAR(driven[1], ramp * 0.5, 1e-15);
    }
}

TEST(GaitTest, AnOffsetDrivesBesideTheBeat) {
    Model model = build_model(load_scene("thesis/creature-1"));
    const Gait straight{1, {0.4, 0.5}, {0.25, 0.125}, 1}, steered{1, {0.4, 0.5}, {0.25, 0.125}, 1, {0.2, -0.3}};
    for (const Scheme scheme : {Scheme::flex, Scheme::conserving}) {
        model.scheme = scheme;
        const double ramp = scheme == Scheme::conserving ? 0.5 : 1;
        const std::vector<double> without = drive(model, straight, 0.125), with = drive(model, steered, 0.125);
        EXPECT_NEAR(with[0] - without[0], ramp * 0.2, 1e-15);
        EXPECT_NEAR(with[1] - without[1], ramp * -0.3, 1e-15);
    }
}

TEST(GaitTest, GaitsOutOfRangeAreRefusedByName) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    const struct {
        Gait gait;
        const char* field;
    } cases[] = {
        {{0, {1, 1}, {0, 0}, 1}, "gait.frequency = 0"},
        {{60.1, {1, 1}, {0, 0}, 1}, "gait.frequency = 60.1"},
        {{nan, {1, 1}, {0, 0}, 1}, "gait.frequency = NaN"},
        {{infinity, {1, 1}, {0, 0}, 1}, "gait.frequency = Infinity"},
        {{1, {1}, {0, 0}, 1}, "gait.amplitude has length 1"},
        {{1, {1, 1, 1}, {0, 0}, 1}, "gait.amplitude has length 3"},
        {{1, {1, 2.1}, {0, 0}, 1}, "gait.amplitude[1] = 2.1"},
        {{1, {-0.1, 1}, {0, 0}, 1}, "gait.amplitude[0] = -0.1"},
        {{1, {1, nan}, {0, 0}, 1}, "gait.amplitude[1] = NaN"},
        {{1, {1, 1}, {}, 1}, "gait.phase has length 0"},
        {{1, {1, 1}, {0, 1.01}, 1}, "gait.phase[1] = 1.01"},
        {{1, {1, 1}, {-1, 0}, 1}, "gait.phase[0] = -1"},
        {{1, {1, 1}, {0, 0}, 0.4}, "gait.power = 0.4"},
        {{1, {1, 1}, {0, 0}, 4.5}, "gait.power = 4.5"},
        {{1, {1, 1}, {0, 0}, 1, {0.5}}, "gait.offset has length 1"},
        {{1, {1, 1}, {0, 0}, 1, {0, nan}}, "gait.offset[1] = NaN"},
        {{1, {1, 1.5}, {0, 0}, 1, {0, -0.6}}, "gait.offset[1] = -0.6"},
    };
    for (const auto& bad : cases) {
        try {
            check_gait(bad.gait, 2);
            ADD_FAILURE() << "accepted " << bad.field;
        } catch (const InputError& error) {
            EXPECT_EQ(std::string(error.what()).find(bad.field), 0u) << error.what();
        }
    }
    EXPECT_NO_THROW(check_gait(Gait{60, {0, 2}, {0, 1}, 4}, 2));
    EXPECT_NO_THROW(check_gait(Gait{1, {0.5, 1.5}, {0, 0}, 1, {-1.5, 0.5}}, 2));
    EXPECT_NO_THROW(check_gait(Gait{}, 0));
}

}  // namespace
}  // namespace natator
