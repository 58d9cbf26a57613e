// Joints that are a line, and muscles that bend up and down.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "natator/evaluate.h"
#include "natator/model.h"
#include "natator/solver.h"
#include "scene/scene_json.h"

namespace natator {
namespace {

using nlohmann::json;

Model model_of_bent(json creature) {
    creature["rearCentre"] = {0, 0, 0};
    return build_model(scene_from_json({{"creature", creature}}, "test"));
}

/// Slices as high as these are wide, and the other way round.
json turned(json creature) {
    for (json& slice : creature["slices"]) std::swap(slice["height"], slice["width"]);
    return creature;
}

/// What bends a body up and down is what bends the body, lying on its side, to the left and right.
TEST(Bend, UpAndDownIsSidewaysOfTheTurnedBody) {
    const json creature = json::parse(R"({"slices":[{"height":5,"width":3,"count":5},{"height":4,"width":4,"count":3},
        {"height":5,"width":2,"count":5}],"joints":[2,6,10]})");
    json vertical = turned(creature);
    vertical["bend"] = "vertical";
    const Model sideways = model_of_bent(creature), up = model_of_bent(vertical);
    ASSERT_EQ(up.actuators, sideways.actuators);
    const auto springs = [](const Model& model, bool turn) {
        std::multiset<std::tuple<int, double, long, long, long, long>> all;
        for (const Muscle& muscle : model.muscles) {
            const Spring& spring = model.springs[muscle.spring];
            const auto half = [&](int particle, int axis) {
                return std::lround(model.position[particle][turn ? 3 - axis : axis] / 0.0375);
            };
            all.insert({muscle.actuator, muscle.lateral, half(spring.a, 1), half(spring.a, 2), half(spring.b, 1),
                        half(spring.b, 2)});
        }
        return all;
    };
    EXPECT_GT(springs(up, true).size(), 40u);
    EXPECT_EQ(springs(up, true), springs(sideways, false));
}

TEST(Bend, ActuatorsThatBendSidewaysComeFirst) {
    json creature = json::parse(R"({"slices":[{"height":4,"width":4,"count":17}],"joints":[4,8,12]})");
    const Model sideways = model_of_bent(creature);
    creature["bend"] = "vertical";
    const Model vertical = model_of_bent(creature);
    creature["bend"] = "both";
    const Model both = model_of_bent(creature);
    ASSERT_EQ(both.actuators, 4);
    ASSERT_EQ(both.springs.size(), sideways.springs.size() + vertical.springs.size());
    for (std::size_t i = 0; i < both.muscles.size(); ++i) {
        const bool first = i < sideways.muscles.size();
        const std::size_t k = first ? i : i - sideways.muscles.size();
        const Model& one = first ? sideways : vertical;
        EXPECT_EQ(both.muscles[i].actuator, one.muscles[k].actuator + (first ? 0 : 2));
        EXPECT_EQ(both.muscles[i].lateral, one.muscles[k].lateral);
        EXPECT_EQ(both.springs[i].a, one.springs[k].a);
        EXPECT_EQ(both.springs[i].b, one.springs[k].b);
    }
    creature["bend"] = {"vertical", "both"};
    creature["springStiffness"] = json::parse("[[0,0],[1,1]]");
    const Model mixed = model_of_bent(creature);  // sideways 4-8's neighbour 8-12, then both gaps up and down
    ASSERT_EQ(mixed.actuators, 3);
    std::map<int, double> stiffness;
    for (const Muscle& muscle : mixed.muscles) stiffness[muscle.actuator] = mixed.springs[muscle.spring].stiffness;
    EXPECT_EQ(stiffness[0], stiffness[2]);
    EXPECT_LT(stiffness[1], stiffness[0]);
}

TEST(Bend, SidewaysIsWhatABodyDoesWithoutAWord) {
    json creature = json::parse(R"({"slices":[{"height":5,"width":3,"count":17}],"joints":[4,8,12]})");
    const Model plain = model_of_bent(creature);
    creature.update({{"bend", "sideways"}, {"joint", "slice"}});
    const Model told = model_of_bent(creature);
    ASSERT_EQ(told.springs.size(), plain.springs.size());
    for (std::size_t i = 0; i < plain.springs.size(); ++i) EXPECT_EQ(told.springs[i].a, plain.springs[i].a);
    for (std::size_t i = 0; i < plain.clusters.size(); ++i)
        EXPECT_EQ(told.clusters[i].particles, plain.clusters[i].particles);
}

/// Particles that two neighbouring clusters share, by y and z in half spacings.
std::set<std::pair<long, long>> shared(const Model& model, int cluster) {
    std::vector<int> front = model.clusters[cluster].particles, rear = model.clusters[cluster + 1].particles, both;
    std::sort(front.begin(), front.end());
    std::sort(rear.begin(), rear.end());
    std::set_intersection(front.begin(), front.end(), rear.begin(), rear.end(), std::back_inserter(both));
    std::set<std::pair<long, long>> places;
    for (const int i : both) {
        EXPECT_NEAR(model.position[i].x(), model.position[model.body.slices[4 * (cluster + 1)][0]].x(), 1e-12);
        places.insert({std::lround(model.position[i].y() / 0.0375), std::lround(model.position[i].z() / 0.0375)});
    }
    EXPECT_EQ(places.size(), both.size());
    return places;
}

TEST(JointLine, IsWhatIsNearestTheLineAboutWhichTheBodyBends) {
    json creature = json::parse(R"({"slices":[{"height":5,"width":3,"count":17}],"joints":[4,8,12],"joint":"line"})");
    using Places = std::set<std::pair<long, long>>;
    const Model sideways = model_of_bent(creature);
    std::set<int> all;
    for (const Cluster& cluster : sideways.clusters) all.insert(cluster.particles.begin(), cluster.particles.end());
    EXPECT_EQ(all.size(), sideways.body.particles.size());
    for (int i = 0; i < 3; ++i) EXPECT_EQ(shared(sideways, i), (Places{{-4, 0}, {-2, 0}, {0, 0}, {2, 0}, {4, 0}}));
    creature["bend"] = "vertical";
    EXPECT_EQ(shared(model_of_bent(creature), 0), (Places{{0, -2}, {0, 0}, {0, 2}}));
    creature["bend"] = "both";
    EXPECT_EQ(shared(model_of_bent(creature), 0), (Places{{0, 0}}));
    creature["bend"] = "sideways";
    creature["slices"][0]["width"] = 4;
    EXPECT_EQ(shared(model_of_bent(creature), 0).size(), 10u);  // the two columns beside the middle
}

/// The thesis' creatures, a body from curves and one from a mesh take it alike: they bend, and go nowhere in vacuum.
class JointLineBody : public testing::TestWithParam<const char*> {};

TEST_P(JointLineBody, BendsAndDoesNotDriftInVacuum) {
    Scene scene =
        load_scene(GetParam(), json::parse(R"({"creature":{"joint":"line","bend":"both"},"fluid":null,"planes":[],
        "solver":{"gravity":[0,0,0]},"duration":0.5,"stopping":{"planeContact":false,"noProgressAfter":0}})"));
    const int actuators = build_model(scene).actuators;
    EXPECT_EQ(actuators, 2 * (static_cast<int>(scene.creature->joints.size()) - 1));
    Gait gait = resting_gait(actuators);
    for (int i = 0; i < actuators; ++i) gait.amplitude[i] = 0.8, gait.phase[i] = 0.1 * (i % 10);
    const Evaluation evaluation = evaluate(scene, gait);
    EXPECT_EQ(evaluation.stopped, StopReason::completed);
    EXPECT_NEAR(evaluation.distance, 0, 0.001);
}

INSTANTIATE_TEST_SUITE_P(Bodies, JointLineBody,
                         testing::Values("open-water/creature-1", "pool/creature-2", "pool/eel", "pool/ray"));

/// The largest angle by which the tail is turned against the head within 0.8 s, rad: to the side, and up or down.
std::pair<double, double> bending(const json& creature) {
    const Scene scene = load_scene(
        "open-water/creature-1",
        {{"creature", creature}, {"fluid", nullptr}, {"planes", json::array()}, {"solver", {{"gravity", {0, 0, 0}}}}});
    const Model model = build_model(scene);
    Gait gait = resting_gait(model.actuators);
    gait.amplitude.assign(gait.amplitude.size(), 0.6);
    Solver<float> solver(model);
    State<float> state = initial_state<float>(model);
    const auto axis = [&](int from, int to) {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const int i : model.body.slices[to]) sum += state.position[i].cast<double>();
        for (const int i : model.body.slices[from]) sum -= state.position[i].cast<double>();
        return sum;
    };
    const int last = static_cast<int>(model.body.slices.size()) - 1;
    double sideways = 0, vertical = 0;
    for (int frame = 1; frame <= 48; ++frame) {
        EXPECT_FALSE(solver.frame(state, gait));
        state.time = frame * model.time_step;
        const Eigen::Vector3d head = axis(2, 0), tail = axis(last, last - 2);
        sideways = std::max(sideways, std::abs(std::atan2(tail.z(), tail.x()) - std::atan2(head.z(), head.x())));
        vertical = std::max(vertical, std::abs(std::atan2(tail.y(), tail.x()) - std::atan2(head.y(), head.x())));
    }
    return {sideways, vertical};
}

TEST(Bend, IsTheWayInWhichTheBodyBends) {
    const auto [sideways, no_rise] = bending({{"bend", "sideways"}});
    EXPECT_GT(sideways, 0.2);
    EXPECT_LT(no_rise, 0.01);
    const auto [no_turn, vertical] = bending({{"bend", "vertical"}});
    EXPECT_GT(vertical, 0.2);
    EXPECT_LT(no_turn, 0.01);
    const auto [turn, rise] = bending({{"bend", "both"}});
    EXPECT_GT(turn, 0.2);
    EXPECT_GT(rise, 0.2);
}

/// Joined by lines a body bends more to the same muscles.
TEST(JointLine, IsSofterThanASlice) {
    EXPECT_GT(bending({{"joint", "line"}}).first, 1.1 * bending({{"joint", "slice"}}).first);
}

}  // namespace
}  // namespace natator
