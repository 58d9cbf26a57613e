// Reynolds, Strouhal and swimming number of known motions.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "bare_particles.h"
#include "model/water_volumes.h"
#include "natator/evaluate.h"
#include "natator/gait.h"
#include "natator/measure.h"
#include "scene/scene_json.h"

namespace natator {
namespace {

constexpr double time_step = 1.0 / 60;

/// A sine of the amplitude (from the middle) on a path that drifts.
std::vector<double> beating(double frequency, double amplitude, double drift, double duration) {
    std::vector<double> path;
    for (int k = 0; k * time_step < duration + 1e-9; ++k) {
        const double t = k * time_step;
        path.push_back(0.7 + drift * t + amplitude * std::sin(2 * std::numbers::pi * frequency * t + 0.4));
    }
    return path;
}

/// A model as swimming_numbers looks at it: a body of length 1.5 in water.
Model swimmer(double viscosity) {
    Model model;
    model.scheme = Scheme::conserving;
    model.parameters.conserving.kinematic_viscosity = viscosity;
    model.position = {{0, 0, 0}, {1, 0, 0}};
    model.velocity = {{0, 0, 0}, {0, 0, 0}};
    model.inverse_mass = {1, 1};
    model.phase = {1, phase::fluid | phase::self_collide};
    model.body = {{0}, {{0}}, 1.5};
    model.actuators = 1;
    return model;
}

TEST(Swimming, PeakToPeakIsTwiceTheAmplitudeWhateverDrifts) {
    for (const double frequency : {0.7, 1.5, 1.861})
        for (const double drift : {0.0, 0.2, -1.0}) {
            const auto found = peak_to_peak(beating(frequency, 0.11, drift, 4), time_step, 1 / frequency);
            ASSERT_TRUE(found);
            EXPECT_NEAR(*found, 0.22, 0.22 * 0.01) << frequency << ' ' << drift;
        }
}

TEST(Swimming, PeakToPeakIsThatOfTheLastThreePeriods) {
    std::vector<double> path = beating(1.5, 0.4, 0, 2);  // three beats
    const std::vector<double> later = beating(1.5, 0.1, 0, 8 / 3.0);
    path.insert(path.end(), later.begin() + 1, later.end());
    EXPECT_NEAR(peak_to_peak(path, time_step, 1 / 1.5).value_or(0), 0.2, 0.002);
}

TEST(Swimming, PeakToPeakNeedsAPeriodOfEightSteps) {
    EXPECT_FALSE(peak_to_peak(beating(1.5, 0.1, 0, 0.6), time_step, 1 / 1.5));
    EXPECT_TRUE(peak_to_peak(beating(1.5, 0.1, 0, 40 * time_step), time_step, 1 / 1.5));
    EXPECT_FALSE(peak_to_peak(beating(8, 0.1, 0, 4), time_step, 1 / 8.0));
    EXPECT_FALSE(peak_to_peak({}, time_step, 1));
}

TEST(Swimming, NumbersOfAKnownMotion) {
    const Gait gait{1.5, {0.3}, {0}, 1};
    std::vector<double> path;  // it gathers speed: 0.1 t^2 backwards
    for (double time = 0; time < 4 + time_step / 2; time += time_step) path.push_back(-0.1 * time * time);
    const auto numbers = swimming_numbers(swimmer(0.01), gait, -0.8, 4, beating(1.5, 0.1, 0.05, 4), path);
    ASSERT_TRUE(numbers);
    EXPECT_NEAR(numbers->tail_amplitude, 0.2, 0.002);
    EXPECT_NEAR(numbers->reynolds.value_or(0), 0.2 * 1.5 / 0.01, 1e-9);
    EXPECT_NEAR(numbers->strouhal.value_or(0), 1.5 * 0.2 / (0.1 * (4 * 4 - 2 * 2) / 2), 0.006);  // of three beats, 2 s
    EXPECT_NEAR(numbers->swimming_number.value_or(0), 2 * std::numbers::pi * 1.5 * 0.2 * 1.5 / 0.01, 3);
}

TEST(Swimming, NumbersThatHaveNoMeaningAreLeftOut) {
    const Gait gait{1.5, {0.3}, {0}, 1};
    const std::vector<double> tail = beating(1.5, 0.1, 0, 4);
    const std::vector<double> still(tail.size(), 0);
    const auto inviscid = swimming_numbers(swimmer(0), gait, 0, 4, tail, still);
    ASSERT_TRUE(inviscid);
    EXPECT_FALSE(inviscid->reynolds || inviscid->swimming_number || inviscid->strouhal);
    Model dry = swimmer(0.01);
    dry.phase[1] = 1;
    EXPECT_FALSE(swimming_numbers(dry, gait, 1, 4, tail, still));
    Model flex = swimmer(0.01);
    flex.scheme = Scheme::flex;
    EXPECT_FALSE(swimming_numbers(flex, gait, 1, 4, tail, still));
    Model lame = swimmer(0.01);
    lame.actuators = 0;
    EXPECT_FALSE(swimming_numbers(lame, {}, 1, 4, tail, still));
}

TEST(Swimming, TheTailIsTheLastSlice) {
    Model model = swimmer(0.01);
    model.body.slices = {{0}, {1, 0}};
    State<float> state;
    state.position = {{0, 0, 1}, {0, 0, 2}};
    EXPECT_EQ(tail_z(model.body, state), 1.5);
    EXPECT_EQ(tail_z(Body{}, state), 0);
}

/// A block of water 2 deep, and a body of two particles in its middle.
Model tank_with_a_body() {
    Model model = test::bare_model(Scheme::conserving, test::lattice(6, 20, 6, 0.1), test::fluid_phase);
    model.parameters.gravity = {0, -3, 0};
    for (const double x : {-0.04, 0.04}) {
        model.body.particles.push_back(model.particles());
        model.position.emplace_back(x, 0, 0);
        model.velocity.emplace_back(Eigen::Vector3d::Zero());
        model.inverse_mass.push_back(1);
        model.phase.push_back(test::solid_phase);
    }
    return model;
}

TEST(Swimming, CavitiesAreWhatLacksDensityDeepInTheWater) {
    const Model model = tank_with_a_body();
    const State<double> state = initial_state<double>(model);
    std::vector<double> densities(model.particles(), 1);
    EXPECT_EQ(cavities(model, state, densities), 0);
    int deep = 0, expected = 0;
    for (int i = 0; i < model.particles(); ++i) {
        const double depth = 0.95 - model.position[i].y();
        if (!model.is_fluid(i) || i % 3 != 0) continue;
        densities[i] = 0.8;  // near the surface, too
        expected += depth > 0.1 + support(model);
        deep += depth > 0.1 + support(model) && i % 2 == 0;
    }
    const std::vector<double> volumes = particle_volumes(model);
    const double body = volumes[model.body.particles[0]] + volumes[model.body.particles[1]];
    ASSERT_GT(expected, 10);
    EXPECT_NEAR(cavities(model, state, densities).value_or(-1), expected * volumes[0] / body, 1e-12);
    for (int i = 0; i < model.particles(); i += 2) densities[i] = 0.95;  // compressed enough to have pressure
    EXPECT_NEAR(cavities(model, state, densities).value_or(-1), (expected - deep) * volumes[0] / body, 1e-12);
}

TEST(Swimming, CavitiesNeedABodyAndADepth) {
    Model model = tank_with_a_body();
    const std::vector<double> densities(model.particles(), 0.5);
    EXPECT_TRUE(cavities(model, initial_state<double>(model), densities));
    model.parameters.gravity.setZero();
    EXPECT_FALSE(cavities(model, initial_state<double>(model), densities));
    model = tank_with_a_body();
    model.body = {};
    EXPECT_FALSE(cavities(model, initial_state<double>(model), densities));
}

/// The water that a fast body leaves behind closes under pressure only.
TEST(Swimming, WaterUnderPressureHasNoCavities) {
    const auto cavities_at = [](double gravity) {
        Scene scene = load_scene(
            "pool/eel", {{"solver", {{"gravity", {0, -gravity, 0}}}}, {"stopping", {{"planeContact", false}}}});
        scene.duration = 1.1;
        const Evaluation swim = evaluate(scene, wave_gait(*scene.creature));
        return swim.swimming ? swim.swimming->cavities.value_or(-1) : -1;
    };
    const double weak = cavities_at(0.5), strong = cavities_at(40);
    std::cout << "measured: " << weak << " and " << strong << " body volumes\n";
    EXPECT_GT(weak, 1);
    EXPECT_GE(strong, 0);
    EXPECT_LT(strong, 0.3);
}

}  // namespace
}  // namespace natator
