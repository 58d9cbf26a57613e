// A tank that goes along with its swimmer: what moving it does to a State, and swims in it beside a long tank.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "natator/error.h"
#include "natator/evaluate.h"
#include "natator/measure.h"
#include "natator/model.h"
#include "natator/simulation.h"
#include "run/moving_tank.h"
#include "scene/scene_json.h"

namespace natator {
namespace {

using nlohmann::json;

/// Creature 1 in a tank as small as it may be.
json small_moving_tank() {
    return json::parse(R"({
        "planes": [[0,1,0,0],[1,0,0,0],[-1,0,0,2.8],[0,0,1,0],[0,0,-1,1]],
        "fluid": {"count": [28, 8, 10]},
        "creature": {"name": "creature-1", "rearCentre": [0.8, 0.45, 0.5]},
        "movingTank": {"step": 0.05},
        "solver": {"solidIterations": 4},
        "settling": {"updates": 5}})");
}

Scene moving_scene(const char* overrides = "{}") {
    json all = small_moving_tank();
    const json patch = json::parse(overrides);
    for (const auto& [key, value] : patch.items()) {
        if (value.is_object())
            all[key].merge_patch(value);
        else
            all[key] = value;  // null too: the scene is not to have it
    }
    return load_scene("endless/creature-2", all);
}

const Gait tail_beat{2, {0.8, 1}, {0, 0.75}, 1};

TEST(MovingTank, MovesByAStepWithWaterAtRestInFront) {
    const Scene scene = moving_scene();
    const Model model = build_model(scene);
    MovingFrame follower(scene, model);
    State<double> state = initial_state<double>(model);
    for (Vector3<double>& velocity : state.velocity) velocity = {0.5, -0.25, 1};
    const State<double> before = state;
    const Pose rest = pose_of(model, model.body, body_places(model.body, state));

    EXPECT_FALSE(follower.is_due(rest.centre + Eigen::Vector3d(0.049, 0, 0)));
    ASSERT_TRUE(follower.is_due(rest.centre + Eigen::Vector3d(0.051, 0, 0)));
    follower.follow(rest.centre + Eigen::Vector3d(0.051, 0, 0), state);

    EXPECT_NEAR((state.origin - Eigen::Vector3d(0.05, 0, 0)).norm(), 0, 1e-15);
    long renewed = 0;
    double mass = 0;
    for (int i = 0; i < model.particles(); ++i) {
        const Eigen::Vector3d moved = state.position[i] + state.origin - before.position[i];
        if (model.is_fluid(i) && before.position[i].x() < 0.05) {
            EXPECT_NEAR((moved - Eigen::Vector3d(2.8, 0, 0)).norm(), 0, 1e-12);
            EXPECT_EQ(state.velocity[i].norm(), 0);
            ++renewed;
            mass += 1 / model.inverse_mass[i];
        } else {
            EXPECT_NEAR(moved.norm(), 0, 1e-12);
            EXPECT_EQ(state.velocity[i], before.velocity[i]);
        }
        EXPECT_GE(state.position[i].x(), 0);
        EXPECT_LE(state.position[i].x(), 2.8);
    }
    EXPECT_GT(renewed, 20);  // half a layer of 80
    EXPECT_EQ(follower.renewal().particles, renewed);
    EXPECT_EQ(follower.renewal().times, 1);
    EXPECT_NEAR((follower.renewal().momentum - mass * Eigen::Vector3d(0.5, -0.25, 1)).norm(), 0, 1e-9 * mass);
    EXPECT_NEAR(follower.renewal().kinetic_energy, mass * (0.25 + 0.0625 + 1) / 2, 1e-9 * mass);
    for (std::size_t k = 0; k < state.cluster_centre.size(); ++k)
        EXPECT_NEAR((state.cluster_centre[k] + state.origin - before.cluster_centre[k]).norm(), 0, 1e-12);
}

TEST(MovingTank, GoesBackWithASwimmerThatDoes) {
    const Scene scene = moving_scene();
    const Model model = build_model(scene);
    MovingFrame follower(scene, model);
    State<float> state = initial_state<float>(model);
    const Eigen::Vector3d centre = pose_of(model, model.body, body_places(model.body, state)).centre;
    follower.follow(centre - Eigen::Vector3d(0.06, 0, 0), state);
    EXPECT_NEAR(state.origin.x(), -0.05, 1e-15);
    for (const Vector3<float>& position : state.position) {
        EXPECT_GE(position.x(), 0);
        EXPECT_LE(position.x(), 2.8f);
    }
}

/// As long as the tank stands still, a current is nothing but another place of the ground.
TEST(MovingTank, ACurrentCarriesTheTankOverGround) {
    const Scene still = moving_scene(R"({"duration": 0.5, "movingTank": {"step": 0.1}})"),
                flowing = moving_scene(R"({"duration": 0.5, "movingTank": {"step": 0.1, "current": [-0.4, 0, 0.2]}})");
    const Evaluation a = evaluate(still, tail_beat), b = evaluate(flowing, tail_beat);
    EXPECT_EQ(a.hash, b.hash);
    EXPECT_NEAR(b.distance, a.distance - 0.4 * 0.5, 1e-12);
    ASSERT_TRUE(a.swimming && b.swimming && a.swimming->reynolds && b.swimming->reynolds);
    EXPECT_NEAR(*b.swimming->reynolds, *a.swimming->reynolds, 1e-6 * *a.swimming->reynolds);
}

TEST(MovingTank, AStreamIsWhatAnEvaluationIs) {
    json overrides = small_moving_tank();
    overrides["movingTank"]["step"] = 0.002;
    overrides["duration"] = 0.25;
    const Evaluation whole = evaluate(load_scene("endless/creature-2", overrides), tail_beat);
    ASSERT_TRUE(whole.renewal);
    EXPECT_GT(whole.renewal->times, 0);
    Simulation<float> live({"endless/creature-2", overrides.dump(), tail_beat});
    while (live.frames() < whole.frames) ASSERT_TRUE(live.step());
    EXPECT_EQ(hash_text(state_hash(live.state())), hash_text(whole.hash));
    EXPECT_NEAR(live.distance(), whole.distance, 1e-6);  // of places that were rounded when they were moved
}

/// The controls of a swim take water and walls away: what is left is a body in vacuum, which gets nowhere by its gait.
TEST(MovingTank, WithoutWaterAndWallsThereIsNone) {
    const Scene scene = moving_scene(
        R"({"duration": 0.5, "fluid": null, "planes": [], "solver": {"gravity": [0, 0, 0]}, "movingTank": {"current": [-0.4, 0, 0]}})");
    const Evaluation swim = evaluate(scene, tail_beat);
    EXPECT_EQ(swim.stopped, StopReason::completed);
    EXPECT_FALSE(swim.renewal);
    EXPECT_NEAR(swim.distance, 0, 1e-5);
}

TEST(MovingTank, ScenesThatItCantFollowAreRefused) {
    const struct {
        const char* overrides;
        const char* word;
    } cases[] = {
        {R"({"scheme": "flex", "solver": {"kinematicViscosity": 0}})", "schemes conserving and lattice only"},
        {R"({"fluid": null})", "needs fluid"},
        {R"({"creature": null})", "needs a creature"},
        {R"({"planes": [[0,1,0,0],[1,0,0,0]]})", "one plane at each end of the tank along x"},
        {R"({"movingTank": {"along": "xz"}})", "along z; must be at least"},
        {R"({"movingTank": {"step": 1}})", "along x; must be at least"},
    };
    for (const auto& bad : cases) {
        const Scene scene = moving_scene(bad.overrides);
        try {
            evaluate(scene, resting_gait(scene.creature ? scene.creature->actuators() : 0));
            ADD_FAILURE() << "accepted " << bad.overrides;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("movingTank"), std::string::npos) << error.what();
            EXPECT_NE(std::string(error.what()).find(bad.word), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace natator
