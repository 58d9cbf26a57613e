// What substeps leave of their constraints, and iterations that go on until it is little.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "natator/evaluate.h"
#include "natator/load_scene.h"

namespace natator {
namespace {

const Gait gait{.frequency = 1.861, .amplitude = {0.973, 0.69}, .phase = {0, 0.648}};

Scene tank(const std::string& scheme, const nlohmann::json& solver = nlohmann::json::object()) {
    return load_scene("bench/small-tank",
                      {{"scheme", scheme}, {"duration", 0.1}, {"settling", {{"updates", 5}}}, {"solver", solver}});
}

struct Told {
    std::vector<Residuals> substeps;
    std::uint64_t hash = 0;

    /// Mean over the substeps.
    double mean(Residual Residuals::* kind) const {
        double sum = 0;
        for (const Residuals& one : substeps) sum += (one.*kind).mean;
        return sum / static_cast<double>(substeps.size());
    }
};

Told residuals_of(const Scene& scene) {
    Told told;
    const auto note = [&](const Residuals& substep) { told.substeps.push_back(substep); };
    told.hash = evaluate(scene, gait, {.execution = {.residuals = note}}).hash;
    return told;
}

TEST(Residuals, AreToldOfEverySubstepOfAFrameAndChangeNoBit) {
    for (const char* const scheme : {"flex", "conserving"}) {
        const Scene scene = tank(scheme);
        const Told told = residuals_of(scene);
        EXPECT_EQ(told.hash, evaluate(scene, gait).hash) << scheme;
        ASSERT_EQ(told.substeps.size(), 6u * 4u) << scheme;
        EXPECT_EQ(told.substeps.front().time, 0);
        EXPECT_NEAR(told.substeps.back().time, 0.1 - 0.1 / 24, 1e-9);
        for (const Residuals& one : told.substeps) {
            EXPECT_EQ(one.iterations, 4);
            for (const Residual& kind : {one.density, one.divergence, one.springs, one.clusters})
                EXPECT_GE(kind.max, kind.mean) << scheme;
        }
        for (const auto kind : {&Residuals::density, &Residuals::springs, &Residuals::clusters})
            EXPECT_GT(told.mean(kind), 0) << scheme;
        EXPECT_EQ(told.mean(&Residuals::divergence) > 0, scheme == std::string("conserving"));
    }
}

TEST(Residuals, AreSmallerWithMoreIterations) {
    const Told few = residuals_of(tank("conserving", {{"numIterations", 2}}));
    const Told many = residuals_of(tank("conserving", {{"numIterations", 16}}));
    EXPECT_LT(many.mean(&Residuals::density), 0.7 * few.mean(&Residuals::density));
    const Told stiffer = residuals_of(tank("conserving", {{"numIterations", 2}, {"solidIterations", 16}}));
    EXPECT_LT(stiffer.mean(&Residuals::springs), 0.7 * few.mean(&Residuals::springs));
    EXPECT_LT(stiffer.mean(&Residuals::clusters), 0.7 * few.mean(&Residuals::clusters));
}

/// The last pass only adds to what the tolerance asks for.
TEST(DensityTolerance, IteratesUntilTheDensityIsMet) {
    const double fixed = residuals_of(tank("conserving")).mean(&Residuals::density), tolerance = fixed / 3;
    const Told told = residuals_of(tank("conserving", {{"densityTolerance", tolerance}, {"maxIterations", 200}}));
    int most = 0;
    for (const Residuals& one : told.substeps) {
        EXPECT_GE(one.iterations, 4);
        EXPECT_LT(one.iterations, 200);
        EXPECT_LE(one.density.mean, tolerance);
        most = std::max(most, one.iterations);
    }
    EXPECT_GT(most, 4);
}

TEST(DensityTolerance, HasLimitsOfIterations) {
    const Told limited = residuals_of(tank("conserving", {{"densityTolerance", 1e-9}, {"maxIterations", 7}}));
    for (const Residuals& one : limited.substeps) EXPECT_EQ(one.iterations, 7);
    const Told easy = residuals_of(tank("conserving", {{"densityTolerance", 1}}));
    for (const Residuals& one : easy.substeps) EXPECT_EQ(one.iterations, 4);
    EXPECT_EQ(easy.hash, evaluate(tank("conserving"), gait).hash);
}

TEST(DensityTolerance, IsNothingToOtherSchemes) {
    const nlohmann::json solver{{"densityTolerance", 1e-9}};
    EXPECT_EQ(evaluate(tank("flex", solver), gait).hash, evaluate(tank("flex"), gait).hash);
}

}  // namespace
}  // namespace natator
