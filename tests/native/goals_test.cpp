// Goals: how poses along a path are scored, and the scenes that they can be asked of.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "natator/error.h"
#include "natator/evaluate.h"
#include "natator/model.h"
#include "run/goals.h"
#include "scene/scene_json.h"

namespace natator {
namespace {

using nlohmann::json;

constexpr double degree_in_radians = std::numbers::pi / 180;

/// Creature 2 in water without an end, asked for these goals.
Scene asked_for(const char* goals, const char* more = "{}") {
    json overrides{{"goals", json::parse(goals)}, {"duration", 4}};
    overrides.update(json::parse(more));
    return load_scene("endless/creature-2", overrides);
}

/// The scores of a path of poses, one each second after the start.
class Path {
public:
    explicit Path(const Scene& scene) : model_(build_model(scene)), record_(scene, model_) { record_.start(Pose{}); }

    /// True if the run ends there.
    bool to(const Eigen::Vector3d& centre, double yaw_degrees = 0) {
        Pose pose;
        pose.centre = centre;
        pose.yaw = std::remainder(yaw_degrees, 360) * degree_in_radians;
        return record_.add(pose, ++time_);
    }
    std::vector<GoalResult> results(double distance = 0, std::optional<double> work = {}) const {
        return record_.results(distance, distance, work);
    }
    double body_mass() const {
        double mass = 0;
        for (const int i : model_.body.particles) mass += 1 / model_.inverse_mass[i];
        return mass;
    }

private:
    Model model_;
    GoalRecord record_;
    double time_ = 0;
};

/// A run ends with a whole frame, which may be later than the duration.
TEST(Goals, WhoArrivesInTheLastFrameHasArrived) {
    Path path(asked_for(R"([{"measure":"reach","target":[1,0,0],"within":0.2}])", R"({"duration":0.99})"));
    path.to({0.9, 0, 0});
    EXPECT_EQ(path.results()[0].score, 1);
}

TEST(Goals, WhatIsNotArrivedAtIsScoredByWhatIsLeft) {
    Path path(asked_for(R"([{"measure":"reach","target":[2,0,0]}])"));
    EXPECT_FALSE(path.to({0.5, 0, 0}));
    EXPECT_NEAR(path.results()[0].score, 0.25, 1e-12);
    EXPECT_NEAR(*path.results()[0].left, 1.5, 1e-12);
    EXPECT_FALSE(path.results()[0].arrived_at);
    EXPECT_FALSE(path.to({-1, 0, 0}));
    EXPECT_NEAR(path.results()[0].score, -0.5, 1e-12);
}

TEST(Goals, ArrivingEarlierIsWorthMore) {
    for (const int seconds : {1, 3}) {
        Path path(asked_for(R"([{"measure":"reach","target":[1,0.1,0],"within":0.2}])"));
        for (int k = 1; k < seconds; ++k) EXPECT_FALSE(path.to({0.1 * k, 0, 0}));
        EXPECT_TRUE(path.to({0.9, 0.05, 0.1}));
        EXPECT_NEAR(path.results()[0].score, 2 - seconds / 4.0, 1e-12);
        EXPECT_EQ(path.results()[0].arrived_at, seconds);
    }
}

TEST(Goals, AGoalThatDoesNotStopTheRunKeepsTheFirstArrival) {
    Path path(asked_for(R"([{"measure":"depth","target":-0.3,"within":0.05,"stop":false}])"));
    EXPECT_FALSE(path.to({0, -0.27, 0}));
    EXPECT_FALSE(path.to({0, 0.1, 0}));
    EXPECT_EQ(path.results()[0].arrived_at, 1);
    EXPECT_NEAR(path.results()[0].score, 1.75, 1e-12);
}

TEST(Goals, TurnsGrowBeyondHalfATurnAndHaveASign) {
    Path path(asked_for(R"([{"measure":"turn","target":-270,"within":10}])"));
    EXPECT_FALSE(path.to({0, 0, 0}, -120));
    EXPECT_FALSE(path.to({0, 0, 0}, -200));
    EXPECT_NEAR(*path.results()[0].left, 70, 1e-9);
    EXPECT_TRUE(path.to({0, 0, 0}, -265));

    Path other(asked_for(R"([{"measure":"turn","target":90}])"));
    EXPECT_FALSE(other.to({0, 0, 0}, -90));
    EXPECT_NEAR(other.results()[0].score, -1, 1e-9);
}

TEST(Goals, HoldingIsScoredByTheMeanDistanceInBodyLengths) {
    Path path(asked_for(R"([{"measure":"hold"}])"));
    EXPECT_NEAR(path.results()[0].score, 1, 1e-12);
    path.to({1.35, 0, 0});
    path.to({0, 0, 0});
    EXPECT_NEAR(path.results()[0].score, 1 / 1.5, 1e-9);  // the body is 1.35 long
}

TEST(Goals, EconomyIsOneOverTheCostOfTransport) {
    Path path(asked_for(R"([{"measure":"economy"}])"));
    EXPECT_NEAR(path.results(0.5, 100.0)[0].score, 0.5 * path.body_mass() / 100, 1e-12);
    EXPECT_EQ(path.results(0.5)[0].score, 0);
}

TEST(Goals, FitnessIsTheWeightedSum) {
    Evaluation result;
    result.distance = 0.7;
    EXPECT_EQ(result.fitness(), 0.7);
    result.goals = {{Goal::Measure::distance, 2, 0.7, {}, {}}, {Goal::Measure::hold, -0.5, 0.4, {}, {}}};
    EXPECT_NEAR(result.fitness(), 1.2, 1e-15);
    result.instability = Instability{};
    EXPECT_EQ(result.fitness(), 0) << "what blows up goes far";
}

/// Refused with one line that holds all of `words`.
void expect_goal_refused(const Scene& scene, const std::vector<std::string>& words) {
    try {
        evaluate(scene, resting_gait(scene.creature ? scene.creature->actuators() : 0));
        ADD_FAILURE() << "accepted; expected a refusal with " << words.front();
    } catch (const InputError& error) {
        for (const std::string& word : words)
            EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
}

TEST(Goals, PlacesThatNobodyCanReachAreRefused) {
    expect_goal_refused(asked_for(R"([{"measure":"depth","target":1.5}])"), {"goals[0]", "above the water", "1.6"});
    expect_goal_refused(asked_for(R"([{"measure":"hold"},{"measure":"depth","target":-1.5}])"),
                        {"goals[1]", "beyond planes[0]"});
    expect_goal_refused(asked_for(R"([{"measure":"reach","target":[0,0,3]}])"), {"goals[0]", "beyond planes[4]"});
    expect_goal_refused(asked_for(R"([{"measure":"reach","target":[9,0,0]}])", R"({"movingTank":null})"),
                        {"beyond planes[2]"});
    expect_goal_refused(asked_for(R"([{"measure":"economy"}])", R"({"creature":{"joints":[8]}})"),
                        {"economy", "muscles"});
}

}  // namespace
}  // namespace natator
