// Scheme conserving, solving for the modified pressure: the water's weight is carried by a hydrostatic pressure that is
// known.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "law_models.h"
#include "model/background_pressure.h"
#include "model/fit_to_water.h"
#include "model/water_volumes.h"
#include "natator/solver.h"
#include "refusal_of.h"
#include "water_figures.h"

namespace natator {
namespace {

using namespace test;

Model modified(Model model) {
    model.parameters.conserving.modified_pressure = true;
    return model;
}

std::vector<bench::WaterFigure> figures_of(const std::string& name, int resolution, int substeps, int iterations,
                                           bool modified_pressure) {
    return water_figures(name,
                         {.scheme = Scheme::conserving,
                          .substeps = substeps,
                          .iterations = iterations,
                          .modified_pressure = modified_pressure},
                         resolution);
}

/// q is 0 down to its level, its slope grows to rho g over a kernel support of 0.25, and the gravity that is left is
/// what that slope leaves. The level is 0.275 deep: two thirds of what two passes hold up in a frame, 0.4, are left to
/// the solver.
TEST(ModifiedPressure, TheCarriedPressureIsHydrostatic) {
    Model model = modified(lattice_of_water({4, 10, 4}));
    model.parameters.substeps = model.parameters.iterations = 1;
    const auto carried = background_pressure<double>(model);
    const double surface = model.particles() * particle_volumes(model).front() / (0.4 * 0.4), level = 0.275;
    EXPECT_NEAR(surface, 1, 0.02);
    const auto at = [&](double below) { return physics::Vec3<double>{0.1, surface - level - below, 0.2}; };
    const double density = 1000, slope = 10 * density;
    EXPECT_EQ(carried.pressure(at(-0.05), density), 0);
    EXPECT_NEAR(carried.pressure(at(0.25), density), slope * 0.125, 1e-9 * slope);
    EXPECT_NEAR(carried.pressure(at(0.6), density) - carried.pressure(at(0.3), density), slope * 0.3, 1e-9 * slope);
    for (const double below : {-0.1, 0.05, 0.2, 0.4}) {
        const double step = 1e-6;
        const double gradient =
            (carried.pressure(at(below + step), density) - carried.pressure(at(below - step), density)) / (2 * step);
        EXPECT_NEAR(carried.acceleration(at(below), true, density, 1e-3, 1).y, -gradient / density, 1e-6) << below;
        EXPECT_NEAR(carried.lift(at(below), density, 1e-3).y, gradient * 1e-3, 1e-6) << below;
        EXPECT_NEAR(carried.acceleration(at(below), false, density, 1e-3, 0.5).y, -gradient * 1e-3 * 0.5, 1e-6)
            << below;
    }
}

/// 48 deep, in one step of two iterations a frame: without it the water falls into itself.
TEST(ModifiedPressure, DeepWaterRestsWithTwoIterations) {
    EXPECT_LE(figures_of("still-water", 48, 1, 2, true).at(0).value, 0.02);  // target of results/water: 0.02
    // Three starts have 0.217 with a deviation of 0.05: three of those are left. It is to miss the target by far.
    EXPECT_GE(figures_of("still-water", 48, 1, 2, false).at(0).value, 0.07);
}

TEST(ModifiedPressure, PressureAndDepthOfAColumnAreHydrostatic) {
    const auto column = figures_of("column", 20, 2, 2, true);
    EXPECT_NEAR(column.at(0).value, 1, 0.02);  // target of results/water: 5 %
    EXPECT_NEAR(column.at(1).value, 2, 0.04);  // target: 2 %
    // Four passes in one substep miss that of the depth. What they reach, 1.9496 with a deviation of 0.0001, is told on
    // that page.
    const auto fast = figures_of("column", 20, 1, 4, true);
    EXPECT_NEAR(fast.at(0).value, 1, 0.02);
    EXPECT_GE(fast.at(1).value, 1.949);
    EXPECT_LE(fast.at(1).value, 2.04);
}

/// A body as heavy as its water weighs nothing: the force on it, what is carried included, is its weight.
TEST(ModifiedPressure, BodiesAreAsBuoyantAsEver) {
    EXPECT_NEAR(figures_of("neutral-sphere", 12, 1, 4, true).at(0).value, 0, 0.01);  // target: 0.01
}

/// Its forces are what changes a body's momentum, its lift by the carried pressure among them.
TEST(ModifiedPressure, ForcesAreWhatTheWaterDoesToABody) {
    const Model model = modified(cube_in_water(1.3, 1));
    const std::vector<int>& body = model.clusters[0].particles;
    State<double> state = initial_state<double>(model);
    Execution execution;
    execution.forces = true;
    Solver<double> solver(model, execution);
    const auto momentum = [&] {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const int i : body) sum += state.velocity[i] / model.inverse_mass[i];
        return sum;
    };
    for (int frame = 0; frame < 5; ++frame) {
        const Eigen::Vector3d before = momentum();
        advance_frames(solver, model, state, 1);
        Eigen::Vector3d force = Eigen::Vector3d::Zero(), weight = force;
        for (const int i : body) {
            force += solver.forces()[i];
            weight += model.parameters.gravity / model.inverse_mass[i];
        }
        EXPECT_LE(((momentum() - before) / model.time_step - force - weight).norm(), 1e-9 * weight.norm()) << frame;
        EXPECT_GT(force.y(), 0.5 * weight.norm());
    }
}

/// The solver is left two thirds of what its passes hold up, 2 (1 + N) s^2/(g h) E: deep water needs no more steps,
/// shallow water is what it was.
TEST(ModifiedPressure, WhatPassesDoNotHoldUpIsCarried) {
    Model whole = lattice_of_water({2, 81, 2}), model = modified(whole);
    EXPECT_NEAR(solved_depth(whole), 8, 1e-9);
    EXPECT_NEAR(solved_depth(model), 2, 1e-9);  // at 2 x 4
    fit_to_water(whole);
    fit_to_water(model);
    EXPECT_EQ(whole.parameters.substeps, 14);
    EXPECT_EQ(model.parameters.substeps, 2);  // as the model has
    model.parameters.iterations = 1;
    EXPECT_NEAR(solved_depth(model), 0.8, 1e-9);
    model.parameters.substeps = 1;
    EXPECT_NEAR(solved_depth(model), 0.4, 1e-9);
    model.parameters.gravity *= 2;                       // E grows by its root
    EXPECT_NEAR(solved_depth(model), 1.5 * 0.25, 1e-9);  // the least
    EXPECT_NEAR(solved_depth(modified(lattice_of_water({2, 16, 2}))), 1.5, 1e-9);
}

/// The thesis' tank is shallow enough for four passes a frame.
TEST(ModifiedPressure, ShallowWaterIsWhatItIsWithoutIt) {
    Model whole = box_of_water({6, 9, 6}), model = modified(whole);
    whole.parameters.substeps = model.parameters.substeps = 1;
    State<float> a = initial_state<float>(whole), b = a;
    Solver<float> first(whole), second(model);
    advance_frames(first, whole, a, 10);
    advance_frames(second, model, b, 10);
    EXPECT_EQ(a.position, b.position);
}

/// What gravity along the floor pushes against a wall is carried by nobody, and takes as many substeps as that depth of
/// water.
TEST(ModifiedPressure, TiltedGravityTakesSubsteps) {
    Model model = modified(box_of_water({20, 20, 3}));
    model.parameters.gravity = {-9, -10, 0};
    model.parameters.substeps = model.parameters.iterations = 1;
    const double weight = std::hypot(9, 10);
    EXPECT_NEAR(min_solved_depth(model), 1.5 * 0.25 + 9 * 1.9 / weight, 0.05);
    fit_to_water(model);
    EXPECT_GT(model.parameters.substeps, 3);
    State<float> state = initial_state<float>(model);
    Solver<float> solver(model);
    advance_frames(solver, model, state, 60);
    EXPECT_LT(std::ranges::max(solver.densities()), 1.2);
}

/// Water that stands beside an obstacle stands higher.
TEST(ModifiedPressure, ObstaclesRaiseTheSurface) {
    Model model = modified(lattice_of_water({4, 10, 4}));
    model.parameters.substeps = model.parameters.iterations = 1;
    const auto begin = [&] { return background_pressure<double>(model).begin; };
    const double without = begin();
    const auto add_solid = [&](double x, double height, double inverse_mass) {
        model.position.push_back({x, height, 0.2});
        model.velocity.push_back(Eigen::Vector3d::Zero());
        model.inverse_mass.push_back(inverse_mass);
        model.phase.push_back(1);
    };
    add_solid(0.2, 0.3, 0);
    const double one = begin();
    EXPECT_NEAR(without - one, particle_volumes(model).back() / (0.4 * 0.4), 1e-12);
    add_solid(0.2, 1.5, 0);    // above the water
    add_solid(0.35, 0.7, 10);  // a body may leave it
    EXPECT_EQ(begin(), one);
}

TEST(ModifiedPressure, WaterThatFallsIntoItsTankIsRefused) {
    Model model = modified(lattice_of_water({2, 16, 2}));
    model.parameters.substeps = model.parameters.iterations = 1;
    EXPECT_TRUE(background_pressure<double>(model).any());
    model.planes[2].offset *= 2;
    EXPECT_NE(refusal_of([&] {
                  background_pressure<double>(model);
              }).find("needs a tank that is full: water begins 1.55 above the floor"),
              std::string::npos);
}

TEST(ModifiedPressure, ThePlanNamesIt) {
    const auto named = [](const Model& model) -> std::string {
        for (const std::string& line : describe_plan(model))
            if (const auto at = line.find("modified pressure"); at != std::string::npos) return line.substr(at);
        return "";
    };
    Model deep = box_of_water({2, 16, 2});
    deep.parameters.substeps = deep.parameters.iterations = 1;
    EXPECT_EQ(named(deep), "");
    EXPECT_EQ(named(modified(deep)), "modified pressure");
    EXPECT_EQ(named(modified(box_of_water({4, 4, 4}))),
              "modified pressure (carries nothing: the water is shallow or weightless)");
}

/// The level is known only in a tank; without weight there is nothing to carry.
TEST(ModifiedPressure, WaterThatIsInNoTankIsRefused) {
    const std::string expected =
        "model: parameters.modifiedPressure = true: needs a tank with one floor and one wall at each end, or "
        "periodic axes";
    Model model = modified(box_of_water({4, 4, 4}));
    EXPECT_EQ(refusal_of([&] { const Solver<float> solver(model); }), "");
    for (std::size_t k = 0; k < model.planes.size(); ++k) {
        Model open = model;
        open.planes.erase(open.planes.begin() + static_cast<std::ptrdiff_t>(k));
        EXPECT_EQ(refusal_of([&] { const Solver<float> solver(open); }), expected) << k;
        open.parameters.gravity.setZero();
        EXPECT_EQ(refusal_of([&] { const Solver<float> solver(open); }), "") << k;
    }
    model.planes.resize(1);
    model.periodic = {{.axis = 0, .low = 0, .high = 0.8}, {.axis = 2, .low = 0, .high = 0.8}};
    EXPECT_EQ(refusal_of([&] { const Solver<float> solver(model); }), "");
}

}  // namespace
}  // namespace natator
