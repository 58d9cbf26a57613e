// Bodies around control points: their regions, what drives them, and what is refused.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "model/skin_weights.h"
#include "natator/model.h"
#include "natator/simulation.h"
#include "refusal.h"
#include "refusal_of.h"
#include "scene/scene_json.h"
#include "test_name.h"

namespace natator {
namespace {

using Eigen::Vector3d;
using nlohmann::json;
using Place = std::array<long, 3>;  // half spacings from the centre of the last slice

class RegionsTest : public testing::TestWithParam<const char*> {
protected:
    Place place(int particle) const {
        const Vector3d at = (model.position[particle] - scene.creature->rear_centre) / scene.creature->spacing * 2;
        return {std::lround(at.x()), std::lround(at.y()), std::lround(at.z())};
    }
    std::map<Place, int> particles() const {
        std::map<Place, int> all;
        for (const int particle : model.body.particles) all[place(particle)] = particle;
        return all;
    }
    /// Its mirror image, by particle.
    std::vector<int> mirrored() const {
        const std::map<Place, int> all = particles();
        std::vector<int> images(model.body.particles.size());
        for (const auto& [at, particle] : all) images[particle] = all.at({at[0], at[1], -at[2]});
        return images;
    }

    Scene scene = load_scene(std::string("pool/") + GetParam());
    Model model = build_model(scene);
};

TEST_P(RegionsTest, CoverTheBodyAndOverlap) {
    std::vector<int> clusters(model.body.particles.size());
    for (const Cluster& cluster : model.clusters)
        for (const int particle : cluster.particles) ++clusters[particle];
    const auto shared = std::count_if(clusters.begin(), clusters.end(), [](int count) { return count > 1; });
    EXPECT_EQ(std::count(clusters.begin(), clusters.end(), 0), 0);
    EXPECT_GT(shared, static_cast<long>(clusters.size()) / 20);
    EXPECT_LT(shared, static_cast<long>(clusters.size()) * 2 / 3);
}

TEST_P(RegionsTest, AreInOnePieceEach) {
    for (const Cluster& cluster : model.clusters) {
        std::set<Place> left;
        for (const int particle : cluster.particles) left.insert(place(particle));
        EXPECT_EQ(left.size(), cluster.particles.size());
        std::vector<Place> front{*left.begin()};
        left.erase(left.begin());
        while (!front.empty()) {
            const Place at = front.back();
            front.pop_back();
            for (int step = 0; step < 27; ++step) {
                const auto next =
                    left.find({at[0] + 2 * (step / 9 - 1), at[1] + 2 * (step / 3 % 3 - 1), at[2] + 2 * (step % 3 - 1)});
                if (next == left.end()) continue;
                front.push_back(*next);
                left.erase(next);
            }
        }
        EXPECT_TRUE(left.empty());
    }
}

TEST_P(RegionsTest, AreSymmetric) {
    const std::vector<int> images = mirrored();
    std::set<std::set<int>> clusters, mirrors;
    for (const Cluster& cluster : model.clusters) {
        clusters.insert({cluster.particles.begin(), cluster.particles.end()});
        std::set<int> mirror;
        for (const int particle : cluster.particles) mirror.insert(images[particle]);
        mirrors.insert(mirror);
    }
    EXPECT_EQ(clusters.size(), model.clusters.size());
    EXPECT_EQ(clusters, mirrors);

    // A gait bends the body as far to the left as to the right, or both sides alike.
    using Fibre = std::tuple<int, int, int, long>;
    std::multiset<Fibre> muscles, mirror_muscles;
    for (const Muscle& muscle : model.muscles) {
        const auto [a, b] = std::pair(model.springs[muscle.spring].a, model.springs[muscle.spring].b);
        const long lateral = std::lround(1e9 * std::abs(muscle.lateral));
        muscles.insert({std::min(a, b), std::max(a, b), muscle.actuator, lateral});
        mirror_muscles.insert(
            {std::min(images[a], images[b]), std::max(images[a], images[b]), muscle.actuator, lateral});
    }
    EXPECT_EQ(muscles, mirror_muscles);
}

TEST_P(RegionsTest, AreTheSameEachTime) {
    const Model again = build_model(load_scene(scene.name));
    ASSERT_EQ(again.clusters.size(), model.clusters.size());
    for (std::size_t i = 0; i < model.clusters.size(); ++i)
        EXPECT_EQ(again.clusters[i].particles, model.clusters[i].particles);
    ASSERT_EQ(again.muscles.size(), model.muscles.size());
    for (std::size_t i = 0; i < model.muscles.size(); ++i)
        EXPECT_EQ(again.muscles[i].lateral, model.muscles[i].lateral);
}

TEST_P(RegionsTest, HaveMusclesThatSpanTheirBorder) {
    EXPECT_EQ(model.actuators, scene.creature->actuators());
    EXPECT_GT(model.actuators, 0);
    EXPECT_LE(model.actuators, 16);
    std::vector<int> count(static_cast<std::size_t>(model.actuators));
    std::vector<double> most(count.size());
    for (const Muscle& muscle : model.muscles) {
        const Spring& spring = model.springs[muscle.spring];
        EXPECT_GE(spring.rest_length, 1.99 * scene.creature->spacing);
        ++count[muscle.actuator];
        most[muscle.actuator] = std::max(most[muscle.actuator], std::abs(muscle.lateral));
        const auto holds = [&](const Cluster& cluster) {
            const auto in = [&](int one) {
                return std::binary_search(cluster.particles.begin(), cluster.particles.end(), one);
            };
            return in(spring.a) + 2 * in(spring.b);
        };
        int ends = 0;
        for (const Cluster& cluster : model.clusters) ends |= holds(cluster);
        EXPECT_EQ(ends, 3);
    }
    for (std::size_t i = 0; i < count.size(); ++i) {
        EXPECT_GE(count[i], 8) << i;
        EXPECT_EQ(most[i], 1) << i;
        EXPECT_GT(scene.creature->regions->places[i], 0);
        EXPECT_LT(scene.creature->regions->places[i], 1);
    }
}

TEST_P(RegionsTest, MoveTheSkin) {
    const std::vector<SkinWeight> weights = skin_weights(*scene.creature, model);
    ASSERT_EQ(weights.size(), scene.creature->skin->vertices.size());
    std::set<int> used;
    for (const auto& [cluster, other, share] : weights) {
        EXPECT_NE(cluster, other);
        EXPECT_LT(std::max(cluster, other), static_cast<int>(model.clusters.size()));
        EXPECT_GE(share, 0.5);
        EXPECT_LE(share, 1);
        used.insert(cluster);
    }
    EXPECT_EQ(used.size(), model.clusters.size());
}

TEST_P(RegionsTest, AreRefined) {
    const Model fine = build_model(load_scene(scene.name, json::parse(R"({"creature":{"refinement":2}})")));
    EXPECT_EQ(fine.body.particles.size(), 8 * model.body.particles.size());
    ASSERT_EQ(fine.muscles.size(), 8 * model.muscles.size());
    double sum = 0, fine_sum = 0;
    for (const Muscle& muscle : model.muscles) sum += std::abs(muscle.lateral);
    for (const Muscle& muscle : fine.muscles) fine_sum += std::abs(muscle.lateral);
    EXPECT_NEAR(fine_sum, 8 * sum, 1e-6 * fine_sum);
}

/// Muscles are forces within the body: alone it stays where it is.
TEST_P(RegionsTest, GoNowhereWithoutWater) {
    Scene vacuum = load_scene(scene.name, json::parse(R"({"fluid":null,"planes":[],"solver":{"gravity":[0,0,0]}})"));
    Gait gait = resting_gait(model.actuators);
    for (int i = 0; i < model.actuators; ++i) gait.amplitude[i] = 0.8, gait.phase[i] = std::fmod(0.3 * i, 1);
    gait.frequency = 1.5;
    Simulation<float> simulation(vacuum);
    const auto place = [&] {
        Vector3d sum = Vector3d::Zero();
        for (const auto& at : simulation.state().position) sum += at.cast<double>();
        return Vector3d(sum / static_cast<double>(simulation.state().position.size()));
    };
    const Vector3d before = place();
    const std::vector<Eigen::Vector3f> start = simulation.state().position;
    double moved = 0;
    for (int frame = 0; frame < 60; ++frame) {
        simulation.step(gait);
        for (std::size_t i = 0; i < start.size(); ++i)
            moved = std::max<double>(moved, (simulation.state().position[i] - start[i]).norm());
    }
    EXPECT_LT((place() - before).norm(), 1e-4);
    EXPECT_GT(moved, 0.5 * scene.creature->spacing);
}

INSTANTIATE_TEST_SUITE_P(All, RegionsTest, testing::Values("jellyfish", "torus", "turtle"),
                         [](const auto& one) { return std::string(one.param); });

Scene with_points(const std::string& scene, const json& points, const std::string& bend = "vertical") {
    return load_scene(scene, json{{"creature", {{"mesh", {{"points", points}}}, {"bend", bend}}}});
}

/// A ring: the head, the end across, the two sides, and what is between; both sides of a pair are driven as one.
TEST(Regions, AreSampledFarFromEachOther) {
    const auto count = [](int points) { return with_points("pool/torus", points).creature->regions->clusters.size(); };
    EXPECT_EQ(count(2), 2u);
    EXPECT_EQ(count(3), 2u);  // the sides come as two
    EXPECT_EQ(count(4), 4u);
    EXPECT_EQ(count(8), 8u);
    EXPECT_EQ(load_scene("pool/torus").creature->actuators(), 4);
    expect_refused("pool/jellyfish", {{"creature", {{"mesh", {{"points", 2}}}}}},
                   "creature.mesh.points: ", {"one point in the middle", "must be 3 or more"});
}

/// Two actuators: around the rim, and from the top to it.
TEST(Regions, OfABellContractRingByRing) {
    const Scene scene = load_scene("pool/jellyfish");
    const Model model = build_model(scene);
    ASSERT_EQ(model.actuators, 2);
    for (const Muscle& muscle : model.muscles) {
        EXPECT_EQ(muscle.lateral, 1);
        const Spring& spring = model.springs[muscle.spring];
        const Vector3d along = (model.position[spring.a] - model.position[spring.b]).normalized();
        EXPECT_EQ(std::abs(along.x()) > 0.3, muscle.actuator == 0);
    }
    for (const Actuator& actuator : scene.creature->actuator_list()) EXPECT_EQ(actuator.bend, Bend::contract);
}

/// The two directions, and which side +1 is on: above, and right between a point and one behind it.
TEST(Regions, BendBothWays) {
    const Scene scene = with_points("pool/ray", 3, "both");
    const Model model = build_model(scene);
    ASSERT_EQ(model.clusters.size(), 3u);
    ASSERT_EQ(model.actuators, 4);
    for (const Muscle& muscle : model.muscles) {
        const Spring& spring = model.springs[muscle.spring];
        const Vector3d at = (model.position[spring.a] + model.position[spring.b]) / 2;
        EXPECT_GT(spring.rest_length, 2 * scene.creature->spacing);
        EXPECT_TRUE(muscle.actuator > 1 || (at.z() - scene.creature->rear_centre.z()) * muscle.lateral > 0);
    }
    const Gait gait = wave_gait(*scene.creature);
    EXPECT_GT(gait.amplitude[1], gait.amplitude[0]);
    EXPECT_EQ(gait.amplitude[2], 0);
}

/// Two boxes side by side have slices like one, but there is no way from one to the other.
TEST(Regions, AreOfABodyInOnePiece) {
    const std::string file =
        (std::filesystem::temp_directory_path() / ("pieces-" + std::to_string(getpid()) + ".obj")).string();
    std::ofstream out(file);
    for (const double z : {-0.5, 0.1})
        for (int i = 0; i < 8; ++i)
            out << "v " << 2 * (i & 1) << ' ' << 0.5 * (i >> 1 & 1) << ' ' << z + 0.4 * (i >> 2) << '\n';
    for (const int first : {1, 9})
        for (const auto& face :
             {std::array{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
            out << 'f';
            for (const int vertex : face) out << ' ' << first + vertex;
            out << '\n';
        }
    out.close();
    const json body = {
        {"mesh", {{"file", file}, {"joints", {0.3, 0.6}}}}, {"spacing", 0.1}, {"rearCentre", {0.5, 0.5, 0.5}}};
    EXPECT_NO_THROW(build_model(load_scene("pool/water", json{{"creature", body}})));
    for (const json& points : {json(4), json::parse("[[0.5,0.2,0.3],[1.5,0.2,0.3]]")}) {
        json changed = body;
        changed["mesh"].erase("joints");
        changed["mesh"]["points"] = points;
        expect_refused("pool/water", {{"creature", changed}}, "creature.mesh.points: ", {"piece"});
    }
    std::filesystem::remove(file);
}

/// Those that a program has made.
TEST(Regions, MustFitTheirBody) {
    const Scene scene = load_scene("pool/torus");
    const auto refused = [&](const std::function<void(Regions&)>& change) {
        Regions regions = *scene.creature->regions;
        change(regions);
        Scene changed = scene;
        changed.creature->regions = std::make_shared<const Regions>(regions);
        return test::refusal_of([&] { build_model(changed); });
    };
    EXPECT_EQ(refused([](Regions&) {}), "");
    const std::vector<std::pair<std::string, std::function<void(Regions&)>>> wrong = {
        {"regions.clusters: particles", [](Regions& regions) { regions.clusters.emplace_back(); }},
        {"regions.clusters = 290", [](Regions& regions) { regions.clusters[1].push_back(290); }},
        {"regions.fibres: front = -1", [](Regions& regions) { regions.fibres[3].front = -1; }},
        {"regions.fibres: rear = 290", [](Regions& regions) { regions.fibres[3].rear = 290; }},
        {"regions.fibres: actuator = 4", [](Regions& regions) { regions.fibres[3].actuator = 4; }},
        {"regions.places: length", [](Regions& regions) { regions.places.pop_back(); }},
        {"regions.skin: length", [](Regions& regions) { regions.skin.pop_back(); }},
        {"regions.skin: other = 8", [](Regions& regions) { regions.skin[0].other = 8; }}};
    for (const auto& [what, change] : wrong)
        EXPECT_NE(refused(change).find(what), std::string::npos) << what << refused(change);
}

const BadInput bad_points[] = {
    {R"({"mesh":{"points":1}})", "creature.mesh.points = 1", "[2, 64]"},
    {R"({"mesh":{"points":65}})", "creature.mesh.points = 65", "[2, 64]"},
    {R"({"mesh":{"points":2.5}})", "creature.mesh.points = 2.5", "whole number"},
    {R"({"mesh":{"points":"many"}})", "creature.mesh.points", "whole number"},
    {R"({"mesh":{"points":[]}})", "creature.mesh.points", "1 to 64 places"},
    {R"({"mesh":{"points":[[-1,0,0],[1,2]]}})", "creature.mesh.points[1]", "array"},
    {R"({"mesh":{"points":[[-1,0,0],[20,0,0]]}})", "creature.mesh.points: point 1 is 11.", "must be within 2"},
    {R"({"mesh":{"points":[[-10,0,0],[-11,0,0]]}})", "points 0 and 1", "farther apart"},
    {R"({"mesh":{"points":[[-10,0,1.4]]}})", "points 0 and 0 or their mirror images", "farther apart"},
    {R"({"mesh":{"points":[[-10,0,0]]}})", "creature.mesh.points: one point", "two or more"},
    {R"({"mesh":{"points":60,"length":0.5}})", "creature.mesh.points: at most", "2 spacings apart"},
    {R"({"mesh":{"points":3,"joints":[0.3,0.5]}})", "creature.mesh.points = 3", "left out beside joints"},
    {R"({"mesh":{"points":3},"bend":["vertical","vertical"]})", "creature.bend", "\"contract\""},
    {R"({"mesh":{"points":3},"joint":"line"})", "creature.joint", "left out beside mesh.points"},
    {R"({"mesh":{"points":3},"muscleSlices":[2,5]})", "creature.muscleSlices", "left out beside mesh.points"},
    {R"({"mesh":{"points":3},"springStiffness":[[0,1],[1,0.5]]})", "creature.springStiffness", "a number"},
    {R"({"bend":"contract"})", "creature.bend", "\"both\""},
};

class BadPointsTest : public testing::TestWithParam<BadInput> {};

TEST_P(BadPointsTest, AreRefusedWithOneLineThatSaysWhere) {
    const BadInput& bad = GetParam();
    expect_refused("pool/ray", {{"creature", json::parse(bad.overrides)}}, bad.field, {bad.allowed});
}

INSTANTIATE_TEST_SUITE_P(All, BadPointsTest, testing::ValuesIn(bad_points));

}  // namespace
}  // namespace natator
