// How far a body bends in vacuum under a fish-like gait: the same at any time step and number of iterations, and nearly
// so at half the spacing.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <nlohmann/json.hpp>
#include <numbers>

#include "natator/measure.h"
#include "natator/model.h"
#include "natator/solver.h"
#include "scene/scene_json.h"

namespace natator {
namespace {

using nlohmann::json;

const Gait fish_like{
    1.5, {0.1, 0.17, 0.24, 0.31, 0.38, 0.45, 0.52, 0.6}, {0, 0.862, 0.724, 0.586, 0.448, 0.31, 0.172, 0.034}, 1};

Model creature_2_in_vacuum(int substeps, int iterations, int refinement, const json& creature = json::object()) {
    json overrides = {
        {"fluid", nullptr},
        {"planes", json::array()},
        {"solver",
         {{"gravity", {0, 0, 0}}, {"substeps", substeps}, {"numIterations", iterations}, {"solidIterations", 1}}},
        {"creature", {{"refinement", refinement}}}};
    overrides["creature"].merge_patch(creature);
    return build_model(load_scene("open-water/creature-2", overrides));
}

Eigen::Vector3d between(const Model& model, const State<float>& state, int from, int to) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int i : model.body.slices[to]) sum += state.position[i].cast<double>();
    for (const int i : model.body.slices[from]) sum -= state.position[i].cast<double>();
    return sum;
}

/// Peak-to-peak angle between the axis at the tail and at the head in the two beats before 1.67 s, rad.
double bending(const Model& model) {
    Solver<float> solver(model);
    State<float> state = initial_state<float>(model);
    std::vector<double> angle{0};
    const int last = static_cast<int>(model.body.slices.size()) - 1;
    for (int frame = 1; frame <= 100; ++frame) {
        EXPECT_FALSE(solver.frame(state, fish_like));
        state.time = frame * model.time_step;
        const Eigen::Vector3d head = between(model, state, 2, 0), tail = between(model, state, last, last - 2);
        double turned = std::atan2(tail.z(), tail.x()) - std::atan2(head.z(), head.x());
        turned -= 2 * std::numbers::pi * std::round((turned - angle.back()) / (2 * std::numbers::pi));
        angle.push_back(turned);
    }
    return peak_to_peak(angle, model.time_step, 1 / fish_like.frequency).value_or(0);
}

TEST(Bending, IsTheSameAtAnyTimeStepAndNumberOfIterations) {
    const double exact = bending(creature_2_in_vacuum(32, 32, 1));
    EXPECT_GT(exact, 1);  // rad; with rigid muscles and clusters of 0.9 the others are 3 % off
    const auto error = [&](int substeps, int iterations) {
        return bending(creature_2_in_vacuum(substeps, iterations, 1)) / exact - 1;
    };
    // 0.0360 with rotations fitted to the end, however many steps that takes; 0.0276 was told by a fit that ended
    // early.
    const double coarse = error(8, 8);
    EXPECT_NEAR(coarse, 0, 0.037);
    // Twice as many of either leave a quarter, as errors of second order do, and a fifth of that for higher orders.
    EXPECT_NEAR(error(8, 16), 0, 0.3 * coarse);
    EXPECT_NEAR(error(16, 8), 0, 0.3 * coarse);
}

/// Without water nothing but the solids is iterated: 4 iterations of 8 each are 32.
TEST(Bending, IterationsOfSolidsAreIterations) {
    Model all = creature_2_in_vacuum(4, 32, 1), of_solids = creature_2_in_vacuum(4, 4, 1);
    of_solids.parameters.conserving.solid_iterations = 8;
    EXPECT_EQ(bending(of_solids), bending(all));
    EXPECT_NE(bending(creature_2_in_vacuum(4, 4, 1)), bending(all));
}

TEST(Bending, IsNearlyTheSameAtHalfTheSpacing) {
    const double part = bending(creature_2_in_vacuum(16, 8, 2)) / bending(creature_2_in_vacuum(16, 8, 1));
    EXPECT_GT(part, 0.9);  // target of results/water: within 10 %
    EXPECT_LT(part, 1);    // the coarse lattice of particles is that of a thicker solid
}

}  // namespace
}  // namespace natator
