// Bodies from curves: the curves, cross-sections on the lattice, the whole body, and what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>

#include "model/water_volumes.h"
#include "natator/error.h"
#include "natator/evaluate.h"
#include "natator/model.h"
#include "refusal.h"
#include "scene/curve.h"
#include "scene/profile_slices.h"
#include "scene/scene_json.h"
#include "test_name.h"

namespace natator {
namespace {

using fields::Curve;
using nlohmann::json;

/// pchip_interpolate([0, .2, .5, 1], [.1, .5, .4, .4], x) of SciPy, and what its derivation gives by hand.
TEST(ProfileCurve, IsThatOfPchip) {
    const Curve curve({{0, 0.1}, {0.2, 0.5}, {0.5, 0.4}, {1, 0.4}});
    // At the first point (2 h0 + h1) d0 - h0 d1, over h0 + h1: (0.7 * 2 + 0.2 / 3) / 0.5.
    const double slope = (0.7 * 2 + 0.2 / 3) / 0.5;
    EXPECT_NEAR(curve.at(0.1), 0.3 + 0.2 * slope / 8, 1e-12);
    EXPECT_NEAR(curve.at(0.35), 0.45, 1e-12);  // no slope at either end
    EXPECT_EQ(curve.at(0.7), 0.4);
    EXPECT_EQ(curve.at(0), 0.1);
    EXPECT_EQ(curve.at(0.2), 0.5);
    EXPECT_EQ(curve.at(2), 0.4);
    EXPECT_NEAR(Curve({{0, 1}, {1, 3}}).at(0.25), 1.5, 1e-12);
}

TEST(ProfileCurve, StaysBetweenNeighbouringPoints) {
    const Curve curve({{0, 0}, {0.1, 0.5}, {0.15, 0.51}, {0.6, 2}, {0.61, 0.2}, {1, 0.1}});
    double before = curve.at(0);
    for (int i = 1; i <= 1000; ++i) {
        const double now = curve.at(i / 1000.0);
        EXPECT_GE(i <= 600 ? now - before : before - now, 0) << i;
        before = now;
    }
}

TEST(ProfileSection, IsRoundSymmetricAndOfTheEllipsesArea) {
    double sum = 0, ideal = 0;
    for (double height = min_across; height < 14; height += 0.13)
        for (double width = min_across; width < 14; width += 0.17) {
            const Slice slice = ellipse_slice(height, width);
            ASSERT_EQ(slice.rows.size(), static_cast<std::size_t>(slice.height));
            ASSERT_GE(slice.height, 2);
            ASSERT_GE(slice.width, 2);
            EXPECT_LE(slice.height, height + 1 + 1e-9);
            EXPECT_LE(slice.width, width + 1 + 1e-9);
            EXPECT_EQ(*std::max_element(slice.rows.begin(), slice.rows.end()), slice.width);
            for (int iy = 0; iy < slice.height; ++iy) {
                EXPECT_EQ(slice.row(iy), slice.row(slice.height - 1 - iy));
                EXPECT_EQ(slice.row(iy) % 2, slice.width % 2);
                const int middle = (slice.height - 1) / 2;  // widest
                EXPECT_LE(slice.row(std::max(0, std::min(iy, middle) - 1)), slice.row(std::min(iy, middle)));
            }
            const double area = std::numbers::pi / 4 * height * width;
            EXPECT_NEAR(slice.particles() / area, 1, std::min(height, width) > 4 ? 0.16 : 1.3)
                << height << ' ' << width;
            sum += slice.particles();
            ideal += area;
        }
    EXPECT_NEAR(sum / ideal, 1, 0.01);
    EXPECT_EQ(ellipse_slice(6, 4).rows, (std::vector<int>{2, 4, 4, 4, 4, 2}));
    EXPECT_EQ(plate_slice(6.4, 1).particles(), 6);
}

/// Ellipses whose height and width are linear, so that the volume is known.
json spindle(double spacing) {
    return json::parse(R"({"scheme": "conserving", "creature": {"profile": {
        "length": 2, "height": [[0, 0.4], [1, 0.8]], "width": [[0, 0.6], [1, 0.3]],
        "joints": [0.25, 0.5, 0.75]}, "clusterStiffness": [[0, 0.8], [1, 0.4]], "springStiffness": [[0, 0.2], [1, 1]]}})")
        .patch(json::array({{{"op", "add"}, {"path", "/creature/spacing"}, {"value", spacing}}}));
}

TEST(Profile, HasTheVolumeOfTheCurvesSolid) {
    // pi / 4 times the integral of (0.4 + 0.4 x) (0.6 - 0.3 x) over the length of 2.
    const double volume = std::numbers::pi / 4 * 2 * (0.24 + 0.12 / 2 - 0.12 / 3);
    for (const auto& [spacing, tolerance] : {std::pair{0.1, 0.05}, std::pair{0.05, 0.02}, std::pair{0.02, 0.005}}) {
        const Model model = build_model(scene_from_json(spindle(spacing), "spindle"));
        EXPECT_NEAR(static_cast<double>(model.particles()) * std::pow(spacing, 3) / volume, 1, tolerance) << spacing;
        EXPECT_EQ(model.body.slices.size(), static_cast<std::size_t>(std::lround(2 / spacing)));
    }
}

TEST(Profile, StiffnessFollowsItsCurveAlongTheBody) {
    const Model model = build_model(scene_from_json(spindle(0.05), "spindle"));  // 40 slices, joints 10, 20, 30
    ASSERT_EQ(model.clusters.size(), 4u);
    const double middles[] = {5.5 / 40, 15.5 / 40, 25.5 / 40, 35 / 40.0};
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(model.clusters[i].stiffness, 0.8 - 0.4 * middles[i], 1e-12) << i;
    ASSERT_EQ(model.actuators, 2);
    for (const Muscle& muscle : model.muscles)
        EXPECT_NEAR(model.springs[muscle.spring].stiffness, 0.2 + 0.8 * middles[muscle.actuator + 1], 1e-12);
}

/// Numbers of a body whose rows are all equal are those of the same body as slices.
TEST(Profile, ARoundSliceWithFullRowsIsAnOrdinaryOne) {
    Scene scene = load_scene("thesis/creature-3");
    const Model plain = build_model(scene);
    for (Slice& slice : scene.creature->slices) slice.rows.assign(static_cast<std::size_t>(slice.height), slice.width);
    const Model rows = build_model(scene);
    EXPECT_EQ(rows.position, plain.position);
    ASSERT_EQ(rows.springs.size(), plain.springs.size());
    for (std::size_t i = 0; i < rows.springs.size(); ++i) {
        EXPECT_EQ(rows.springs[i].a, plain.springs[i].a);
        EXPECT_EQ(rows.springs[i].b, plain.springs[i].b);
        EXPECT_EQ(rows.muscles[i].lateral, plain.muscles[i].lateral);
    }
}

/// FNV-1a of what a creature's body is made of, by its numbers as they are in memory.
std::uint64_t digest(const Model& model) {
    std::uint64_t hash = 14695981039346656037u;
    const auto add = [&](const auto& value) {
        const auto* bytes = reinterpret_cast<const unsigned char*>(&value);
        for (std::size_t i = 0; i < sizeof value; ++i) hash = (hash ^ bytes[i]) * 1099511628211u;
    };
    for (const int i : model.body.particles) {
        for (int axis = 0; axis < 3; ++axis) add(model.position[i][axis]);
        add(model.inverse_mass[i]);
    }
    for (const Spring& spring : model.springs)
        add(spring.a), add(spring.b), add(spring.rest_length), add(spring.stiffness);
    for (const Muscle& muscle : model.muscles) add(muscle.spring), add(muscle.actuator), add(muscle.lateral);
    for (const Cluster& cluster : model.clusters) {
        for (const int particle : cluster.particles) add(particle);
        for (const Eigen::Vector3d& offset : cluster.rest_offset)
            for (int axis = 0; axis < 3; ++axis) add(offset[axis]);
        add(cluster.stiffness);
    }
    return hash;
}

/// Of the program before there were profiles.
TEST(Profile, TheFourCreaturesAreWhatTheyWere) {
    for (const auto& [scene, hash] :
         std::map<std::string, std::uint64_t>{{"thesis/creature-1", 0x5de9bba8743e12bau},
                                              {"thesis/creature-2", 0x34744f64c38458adu},
                                              {"thesis/creature-3", 0x2c31ff83b6cbfd1au},
                                              {"thesis/creature-4", 0xb94e521eac2a5d04u},
                                              {"open-water/creature-1", 0x6a74b32b34150722u},
                                              {"open-water/creature-2", 0xc00ceec2cf2f1345u},
                                              {"open-water/creature-3", 0xbad65a187ac8e749u},
                                              {"open-water/creature-4", 0xeb8e719f3fc7a0c3u}})
        EXPECT_EQ(digest(build_model(load_scene(scene))), hash) << scene;
}

struct Bundled {
    const char* name;
    int actuators;
    double lag;  ///< of each actuator behind the one before it, for a wave that drives it; in periods
};

void PrintTo(const Bundled& bundled, std::ostream* out) {
    test::print_name(bundled.name, out);
}

class ProfileBodyTest : public testing::TestWithParam<Bundled> {
protected:
    Scene scene = load_scene(std::string("pool/") + GetParam().name);
    Model model = build_model(scene);
};

TEST_P(ProfileBodyTest, IsSymmetricLeftAndRight) {
    EXPECT_EQ(model.actuators, GetParam().actuators);
    EXPECT_EQ(model.clusters.size(), scene.creature->joints.size() + 1);
    const double spacing = scene.creature->spacing;
    using Place = std::array<long, 3>;  // in half spacings from the rear centre
    std::set<Place> places;
    for (const int i : model.body.particles) {
        const Eigen::Vector3d at = (model.position[i] - scene.creature->rear_centre) / spacing * 2;
        EXPECT_LT((at - at.array().round().matrix()).norm(), 1e-9);  // on the lattice
        places.insert({std::lround(at.x()), std::lround(at.y()), std::lround(at.z())});
    }
    EXPECT_EQ(places.size(), model.body.particles.size());
    for (const Place& place : places) EXPECT_TRUE(places.count({place[0], place[1], -place[2]}));
    std::vector<double> left(static_cast<std::size_t>(model.actuators)), right(left.size());
    for (const Muscle& muscle : model.muscles) (muscle.lateral < 0 ? left : right)[muscle.actuator] += muscle.lateral;
    for (std::size_t i = 0; i < left.size(); ++i) {
        EXPECT_NEAR(left[i] + right[i], 0, 1e-12);
        EXPECT_GE(right[i], 4) << "actuator " << i;
    }
}

/// Neither floats nor sinks: its weight is that of the water that its volume displaces.
TEST_P(ProfileBodyTest, IsAsHeavyAsItsWater) {
    const std::vector<double> volumes = particle_volumes(model);
    double mass = 0, volume = 0;
    for (const int i : model.body.particles) {
        mass += 1 / model.inverse_mass[i];
        volume += volumes[i];
    }
    EXPECT_NEAR(mass / (volume * fluid_density(model, volumes)), 1, 0.005);
}

/// Its volume is that of the curves, as far as few particles across can follow them.
TEST_P(ProfileBodyTest, FollowsItsCurves) {
    const json profile =
        scene_definition("pool/" + std::string(GetParam().name), json::object())["creature"]["profile"];
    const fields::Place nowhere{"", ""};
    const fields::Range any{0, 1000};
    const Curve height = fields::read_curve(profile["height"], nowhere, any);
    const Curve width = fields::read_curve(profile["width"], nowhere, any);
    const bool fin = profile.contains("fin");
    const Curve tall = fin ? fields::read_curve(profile["fin"]["height"], nowhere, any, 1) : Curve({{1, 0}});
    constexpr int parts = 1000;
    double volume = 0;
    for (int i = 0; i < parts; ++i) {
        const double x = (i + 0.5) / parts;
        const bool in_fin = fin && x >= tall.first();
        const double area = in_fin ? tall.at(x) * profile["fin"]["thickness"].get<double>()
                                   : std::numbers::pi / 4 * height.at(x) * width.at(x);
        volume += area * profile["length"].get<double>() / parts;
    }
    const double found = static_cast<double>(model.body.particles.size()) * std::pow(scene.creature->spacing, 3);
    EXPECT_NEAR(found / volume, 1, 0.05);
}

TEST_P(ProfileBodyTest, IsRefinedLikeAnyOther) {
    const Model fine = build_model(
        load_scene(std::string("pool/") + GetParam().name, json::parse(R"({"creature":{"refinement":2}})")));
    EXPECT_EQ(fine.body.particles.size(), 8 * model.body.particles.size());
    EXPECT_EQ(fine.springs.size(), 8 * model.springs.size());
}

/// A wave that travels to the tail drives it forward, and without water nowhere.
TEST_P(ProfileBodyTest, SwimsByATravellingWave) {
    Gait gait = resting_gait(model.actuators);
    gait.frequency = 1.5;
    for (int i = 0; i < model.actuators; ++i) {
        gait.amplitude[i] = 1;
        gait.phase[i] = i == 0 ? 0 : 1 - i * GetParam().lag;
    }
    scene.duration = 0.75;
    scene.stopping = {.plane_contact = false, .no_progress_after = 0};
    const Evaluation water = evaluate(scene, gait);
    EXPECT_EQ(water.stopped, StopReason::completed);
    EXPECT_GT(water.distance, 0.02);  // 0.16, 0.03 and 0.06 when this was written
    scene.fluid.reset();
    scene.planes.clear();
    scene.solver.gravity = {0, 0, 0};
    EXPECT_NEAR(evaluate(scene, gait).distance, 0, 0.001);
}

INSTANTIATE_TEST_SUITE_P(Bundled, ProfileBodyTest,
                         testing::Values(Bundled{"eel", 8, 1 / 8.0}, Bundled{"tuna", 4, 1 / 6.0},
                                         Bundled{"tadpole", 5, 1 / 6.0}));

const BadInput bad_profiles[] = {
    {R"({"profile":{"width":[[0,0.2],[0.6,0.06],[1,0.2]]}})", "creature.profile.width: ", "thinner than two particles"},
    {R"({"profile":{"height":0.1}})", "creature.profile.height: 0.1 at 0.025 of the length, slice 0 of 20", "0.1125"},
    {R"({"profile":{"height":80}})", "creature.profile.height: 80 at", "at most 1000 spacings"},
    {R"({"profile":{"height":[[0,0.2],[0.5,0.4],[0.4,0.3],[1,0.2]]}})", "creature.profile.height[2][0] = 0.4",
     "more than 0.5"},
    {R"({"profile":{"height":[[0,0.2],[0.5,0.4],[0.5,0.3],[1,0.2]]}})", "creature.profile.height[2][0] = 0.5",
     "ascend"},
    {R"({"profile":{"height":[[0.1,0.2],[1,0.4]]}})", "creature.profile.height[0][0] = 0.1", "at 0"},
    {R"({"profile":{"height":[[0,0.2],[0.8,0.4]]}})", "creature.profile.height[1][0] = 0.8", "at least 0.9"},
    {R"({"profile":{"height":[[0,0.2],[1.2,0.4]]}})", "creature.profile.height[1][0] = 1.2", "[0, 1]"},
    {R"({"profile":{"width":[[0,-0.2],[1,0.4]]}})", "creature.profile.width[0][1] = -0.2", "[0, 1000]"},
    {R"({"profile":{"width":[[0,0.2]]}})", "creature.profile.width", "2 to 1000 points"},
    {R"({"profile":{"width":[0.2,0.3]}})", "creature.profile.width[0] = 0.2", "a point"},
    {R"({"profile":{"width":"0.2"}})", "creature.profile.width", "a number, or a curve"},
    {R"({"profile":{"hight":0.3}})", "creature.profile.hight", "did you mean height?"},
    {R"({"profile":{"length":0}})", "creature.profile.length = 0", "(0, 1000]"},
    {R"({"profile":{"length":0.1}})", "creature.profile.length = 0.1", "2 to 10000 spacings"},
    {R"({"profile":{"joints":[0.5,0.51]}})", "creature.profile.joints[1] = 0.51", "behind slice 10"},
    {R"({"profile":{"joints":[0.5,0.4]}})", "creature.profile.joints[1] = 0.4", "behind slice 10"},
    {R"({"profile":{"joints":[0.01]}})", "creature.profile.joints[0] = 0.01", "behind the first"},
    {R"({"profile":{"joints":[0.99]}})", "creature.profile.joints[0] = 0.99", "not in the last"},
    {R"({"profile":{"joints":[0.5,0.95]}})", "creature.profile.joints[1] = 0.95", "not in the last"},
    {R"({"profile":{"joints":[0.5,0.92]}})", "creature.profile.joints[0], [1] = slices 10, 18", "2 wide"},
    {R"({"profile":{"fin":{"height":0.5}}})", "creature.profile.fin.height = 0.5", "from where the fin begins"},
    {R"({"profile":{"fin":{"height":[[0,0.5],[1,0.5]]}}})", "creature.profile.fin.height[0][0] = 0",
     "a body before it"},
    {R"({"profile":{"fin":{"height":[[0.99,0.5],[1,0.5]]}}})", "creature.profile.fin.height[0][0] = 0.99", "0.975"},
    {R"({"profile":{"fin":{"height":[[0.9,0.05],[1,0.06]]}}})", "creature.profile.fin.height: ", "thinner than two"},
    {R"({"profile":{"fin":{"thickness":0.03}}})", "creature.profile.fin.thickness = 0.03", "half a spacing"},
    {R"({"joints":[3,5]})", "creature.joints", "left out beside profile"},
    {R"({"clusterStiffness":[[0,0.5],[1,1.5]]})", "creature.clusterStiffness[1][1] = 1.5", "[0, 1]"},
    {R"({"springStiffness":[[0.5,0.5],[1,1]]})", "creature.springStiffness[0][0] = 0.5", "covers 0 to 1"},
};

class BadProfileTest : public testing::TestWithParam<BadInput> {};

TEST_P(BadProfileTest, IsRefusedWithOneLineThatSaysWhere) {
    const BadInput& bad = GetParam();
    expect_refused("pool/tuna", {{"creature", json::parse(bad.overrides)}}, bad.field, {bad.allowed});
}

INSTANTIATE_TEST_SUITE_P(All, BadProfileTest, testing::ValuesIn(bad_profiles));

/// What an override cannot take away.
TEST(Profile, NamesWhatIsMissing) {
    const auto message = [](const char* key, const json& value) {
        json scene = spindle(0.1);
        json& profile = scene["creature"]["profile"];
        profile.erase(key);
        if (!value.is_null()) profile[key] = value;
        try {
            scene_from_json(scene, "spindle");
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    for (const std::string key : {"length", "height", "width", "joints"})
        EXPECT_EQ(message(key.c_str(), nullptr),
                  "scene \"spindle\": creature.profile." + key + ": missing; must be given");
    EXPECT_NE(
        message("height", json::parse("[[0,0.2],[0.9,0.4]]")).find("height[1][0] = 0.9: must be at 1 of the length"),
        std::string::npos);
}

/// What only the creature's file has: an override's null takes it away, also through a scene that builds on another.
TEST(Profile, NullTakesAwayWhatTheCreaturesFileHas) {
    const json no_fin = json::parse(R"({"creature":{"profile":{"fin":null,"height":0.3,"width":0.2}}})");
    EXPECT_TRUE(scene_definition("pool/tuna", json::object())["creature"]["profile"].contains("fin"));
    const json definition = scene_definition("pool/tuna", no_fin);
    EXPECT_FALSE(definition["creature"]["profile"].contains("fin"));
    EXPECT_EQ(definition["creature"]["profile"]["joints"].size(), 5u);
    EXPECT_EQ(load_scene("pool/tuna", no_fin).creature->slices.back().width, 3);

    const std::string file = testing::TempDir() + "natator-without-fin.json";
    std::ofstream(file) << json{{"base", "pool/tuna"}, {"creature", no_fin["creature"]}};
    EXPECT_EQ(scene_definition(file, json::object())["creature"], definition["creature"]);
    const json with_stiffness = scene_definition(file, json::parse(R"({"creature":{"springStiffness":0.5}})"));
    EXPECT_FALSE(with_stiffness["creature"]["profile"].contains("fin"));
    EXPECT_EQ(with_stiffness["creature"]["springStiffness"], 0.5);
    std::filesystem::remove(file);

    const json file_spacing = scene_definition("pool/eel", json::object())["creature"]["spacing"];
    EXPECT_NE(file_spacing, 1);
    EXPECT_EQ(scene_definition("pool/eel",
                               json::parse(R"({"creature":{"description":null,"spacing":1}})"))["creature"]["spacing"],
              1);
    const json own = json::parse(
        R"({"creature":{"name":"mine","slices":[{"height":2,"width":2,"count":3}],"joints":[],"spacing":null}})");
    EXPECT_FALSE(scene_definition("pool/eel", own)["creature"].contains("spacing"));
}

/// A profile of a scene takes the place of the slices that its creature's file has, and needs no file.
TEST(Profile, TakesThePlaceOfSlices) {
    const json profile = scene_definition("pool/eel", json::object())["creature"]["profile"];
    const Scene scene = load_scene("pool/creature-1", json{{"creature", {{"profile", profile}}}});
    EXPECT_EQ(scene.creature->slices.size(), 20u);
    EXPECT_EQ(scene.creature->particle_mass, 0.421875);
    EXPECT_EQ(build_model(scene).actuators, 8);
    const json own = {{"profile", profile}, {"rearCentre", {1, 0.8, 0.8}}};
    const Scene nameless = load_scene("open-water/water", json{{"creature", own}});
    EXPECT_EQ(nameless.creature->slices.size(), 20u);
}

}  // namespace
}  // namespace natator
