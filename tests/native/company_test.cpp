// More than one body in a tank, and obstacles.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "natator/error.h"
#include "natator/evaluate.h"
#include "natator/model.h"
#include "scene/scene_json.h"

namespace natator {
namespace {

using nlohmann::json;

const Gait first_gait{1.861, {0.973, 0.69}, {0, 0.648}, 1}, second_gait{1, {0.5, 0.25}, {0.25, 0.5}, 1};

json creature_1_at(double x, double z) {
    return {{"name", "creature-1"}, {"rearCentre", {x, 0.6, z}}};
}

json company_of(double x, double z) {
    return json::array({{{"creature", creature_1_at(x, z)},
                         {"gait", {{"frequency", 1}, {"amplitude", {0.5, 0.25}}, {"phase", {0.25, 0.5}}}}}});
}

/// Creature 1 in vacuum, with a twin beside it, gaits of their own.
Scene pair_in_vacuum(double aside, const json& more = json::object()) {
    json overrides{{"scheme", "conserving"}, {"duration", 0.5}, {"companions", company_of(0.45, 0.6 + aside)}};
    overrides.merge_patch(more);
    return load_scene("thesis/creature-1-vacuum", overrides);
}

TEST(ModelGroup, ACompanionIsACopyOfItsCreatureBehindTheBody) {
    const Scene scene = pair_in_vacuum(1);
    const Model pair = build_model(scene), alone = build_model(load_scene("thesis/creature-1-vacuum", json::object()));
    const int n = alone.particles();
    ASSERT_EQ(pair.particles(), 2 * n);
    ASSERT_EQ(pair.companions.size(), 1u);
    EXPECT_EQ(pair.actuators, 2);
    EXPECT_EQ(pair.companions[0].first_actuator, 2);
    for (int i = 0; i < n; ++i) {
        EXPECT_NEAR((pair.position[n + i] - pair.position[i] - Eigen::Vector3d(0, 0, 1)).norm(), 0, 1e-12);
        EXPECT_NE(pair.phase[n + i] & phase::group_mask, pair.phase[i] & phase::group_mask);
    }
    ASSERT_EQ(pair.muscles.size(), 2 * alone.muscles.size());
    for (std::size_t k = 0; k < alone.muscles.size(); ++k) {
        const Muscle& one = pair.muscles[k];
        const Muscle& two = pair.muscles[alone.muscles.size() + k];
        EXPECT_EQ(two.actuator, one.actuator + 2);
        EXPECT_EQ(pair.springs[two.spring].a, pair.springs[one.spring].a + n);
    }
}

/// The companion's muscles work, too, but for themselves.
TEST(ModelGroup, AnEvaluationHasTheWorkOfTheSwimmersOwnMuscles) {
    const Gait gait{1, {0.5, 0.25}, {0, 0.25}, 1};
    const Scene scene = pair_in_vacuum(1);
    Scene alone = scene;
    alone.companions.clear();
    const double own = evaluate(alone, gait).work.value();
    EXPECT_GT(own, 0);
    EXPECT_NEAR(evaluate(scene, gait).work.value(), own, 1e-4 * own);
}

TEST(ModelGroup, EachIsDrivenByItsOwnGait) {
    const Model pair = build_model(pair_in_vacuum(1));
    const Model alone = build_model(load_scene("thesis/creature-1-vacuum", json{{"scheme", "conserving"}}));
    State<double> both = initial_state<double>(pair), first = initial_state<double>(alone), second = first;
    actuate(pair, first_gait, 0.4, both);
    actuate(alone, first_gait, 0.4, first);
    actuate(alone, second_gait, 0.4, second);
    const std::size_t springs = first.spring_rest_length.size();
    for (std::size_t k = 0; k < springs; ++k) {
        EXPECT_EQ(both.spring_rest_length[k], first.spring_rest_length[k]);
        EXPECT_EQ(both.spring_rest_length[springs + k], second.spring_rest_length[k]);
    }
}

/// Two bodies far from each other in vacuum know nothing of each other.
TEST(ModelGroup, FarApartEachMovesAsIfAlone) {
    const EvaluationOptions in_double{.precision = Precision::double_precision};
    const Evaluation pair = evaluate(pair_in_vacuum(1, {{"solver", {{"gravity", {1, 0, 0}}}}}), first_gait, in_double);
    const Evaluation alone =
        evaluate(load_scene("thesis/creature-1-vacuum",
                            json{{"scheme", "conserving"}, {"duration", 0.5}, {"solver", {{"gravity", {1, 0, 0}}}}}),
                 first_gait, in_double);
    EXPECT_NEAR(pair.distance, alone.distance, 1e-9);
    ASSERT_EQ(pair.companions.size(), 1u);
    EXPECT_EQ(pair.companions[0].creature, "creature-1");
    EXPECT_NEAR(pair.companions[0].distance, alone.distance, 1e-3);  // both fall alike; their beats differ
    EXPECT_GT(pair.companions[0].distance, 0.1);
}

/// A body that falls onto an obstacle stays above it; without the obstacle it falls on.
TEST(ModelGroup, AnObstacleHoldsABodyUp) {
    const json fall{{"duration", 1}, {"companions", json::array()}, {"solver", {{"gravity", {0, -10, 0}}}}};
    json held = fall;
    held["obstacles"] = json::array({{{"shape", "box"}, {"centre", {1, 0.15, 0.6}}, {"size", {2, 0.2, 1}}}});
    const auto height_at_end = [](const json& overrides) {
        double height = 0;
        EvaluationOptions options;
        options.on_frame = [&](double, const auto& places) {
            height = 0;
            for (const Eigen::Vector3d& place : places) height += place.y() / static_cast<double>(places.size());
        };
        evaluate(pair_in_vacuum(1, overrides), resting_gait(2), options);
        return height;
    };
    EXPECT_LT(height_at_end(fall), -1);
    EXPECT_GT(height_at_end(held), 0.25);
}

/// Particles of a bundled hoop: as many as its volume asks for, none on its axis, and where its file says it is.
TEST(ModelGroup, AMeshIsAnObstacleOfItsForm) {
    const auto hoop = [](const json& keys) {
        json obstacle{{"shape", "mesh"}, {"file", "hoop.obj"}, {"unit", 0.5}, {"centre", {3, 1, 0.8}}};
        obstacle.update(keys);
        return load_scene("open-water/water", json{{"obstacles", json::array({obstacle})}}).obstacles.at(0);
    };
    const Obstacle along_x = hoop(json::object());
    const double tube = 0.28 * 0.5, volume = 2 * std::pow(std::numbers::pi, 2) * 0.5 * tube * tube;
    EXPECT_NEAR(static_cast<double>(along_x.points.size()) * std::pow(0.075, 3) / volume, 1, 0.05);
    double nearest_axis = 1;
    for (const Eigen::Vector3d& point : along_x.points) {
        nearest_axis = std::min(nearest_axis, std::hypot(point.y(), point.z()));
        EXPECT_LE(std::abs(point.x()), tube);
    }
    EXPECT_GT(nearest_axis, 0.5 - tube - 0.01);
    EXPECT_TRUE(along_x.holds({3, 1.5, 0.8}));
    EXPECT_FALSE(along_x.holds({3, 1, 0.8}));  // the hole
    const Obstacle along_y = hoop({{"forward", "y"}, {"up", "x"}});
    EXPECT_FALSE(along_y.holds({3, 1.5, 0.8}));
    EXPECT_TRUE(along_y.holds({3.5, 1, 0.8}));
}

/// Obstacles that share a face, or overlap, are one: no two particles lie in each other, which would have no volume.
TEST(ModelGroup, ObstaclesThatTouchAreOne) {
    const auto box = [](double centre, double length) -> json {
        return {{"shape", "box"}, {"centre", {centre, 0.3, 1}}, {"size", {length, 0.3, 0.3}}};
    };
    const auto obstacles = [](const json& boxes) {
        const Model model = build_model(load_scene("open-water/water", json{{"obstacles", boxes}}));
        std::vector<std::array<long, 3>> places;
        for (int i = 0; i < model.particles(); ++i) {
            if (model.is_fluid(i)) continue;
            const Eigen::Vector3d at = model.position[i] * 1e6;
            places.push_back({std::lround(at.x()), std::lround(at.y()), std::lround(at.z())});
        }
        std::sort(places.begin(), places.end());
        return places;
    };
    const auto whole = obstacles(json::array({box(1.15, 0.6)}));
    EXPECT_EQ(whole.size(), 9u * 5 * 5);
    EXPECT_EQ(obstacles({box(1, 0.3), box(1.3, 0.3)}), whole);
    EXPECT_EQ(obstacles({box(1, 0.3), box(1.15, 0.3), box(1.3, 0.3)}), whole);
    EXPECT_EQ(obstacles({box(1, 0.3), box(1.3 + 1e-7, 0.3)}).size(), whole.size());
    EXPECT_EQ(obstacles({box(1, 0.3), box(1.4, 0.3)}).size(), 2 * 5u * 5 * 5);
    const json standing{{"shape", "box"}, {"centre", {3, 0.3, 0.8}}, {"size", {0.2, 0.6, 0.2}}, {"spacing", 0.1}};
    EXPECT_EQ(obstacles(json::array({standing})).size(), 3u * 7 * 3);  // on the floor, by rounding beneath it
}

TEST(ModelGroup, AnObstacleThatIsTooLargeIsNamed) {
    const auto refusal = [](const json& last) {
        const json sphere{{"shape", "sphere"}, {"centre", {1, 1, 1}}, {"radius", 0.5}, {"spacing", 0.005}};
        try {
            build_model(load_scene("open-water/water", json{{"obstacles", {sphere, last}}}));
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_NE(refusal({{"shape", "sphere"}, {"centre", {3, 1, 1}}, {"radius", 1}, {"spacing", 0.001}})
                  .find("obstacles[1]: up to 8012006001 particles: must be at most 16000000"),
              std::string::npos);
    EXPECT_NE(refusal({{"shape", "box"}, {"centre", {3, 1, 1}}, {"size", {1, 1, 1}}, {"spacing", 0.005}})
                  .find("obstacles together): must be at most 16000000"),
              std::string::npos);
    EXPECT_NE(refusal({{"shape", "sphere"}, {"centre", {3, 1, 1}}, {"radius", 1}, {"file", "none.obj"}})
                  .find("obstacles[1].file: unknown key (= \"none.obj\")"),
              std::string::npos);
}

TEST(ModelGroup, AnObstacleFromAMeshIsInTheModelAndInTheDefinition) {
    const Scene scene = load_scene("company/hoop", json::object());
    const Model model = build_model(scene);
    std::size_t fixed = 0;
    for (const double inverse_mass : model.inverse_mass) fixed += inverse_mass == 0;
    EXPECT_EQ(fixed, scene.obstacles.at(0).points.size());
    const json definition = scene_definition("company/hoop", json::object());
    EXPECT_EQ(definition["obstacles"][0]["digest"].get<std::string>().size(), 16u);
    const json changed{
        {"obstacles",
         json::array({{{"shape", "mesh"}, {"file", "hoop.obj"}, {"digest", "0"}, {"centre", {3, 1, 1}}}})}};
    EXPECT_THROW(load_scene("company/hoop", changed), InputError);
}

}  // namespace
}  // namespace natator
