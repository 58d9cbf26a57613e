// Named scenes, their defaults, bases and overrides.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "natator/error.h"
#include "natator/model.h"
#include "refusal_of.h"
#include "run/settled_state_key.h"
#include "scene/scene_json.h"

namespace natator {
namespace {

using nlohmann::json;

/// A folder for files of one test, removed afterwards.
class SceneFiles : public testing::Test {
protected:
    SceneFiles() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        directory_ = std::filesystem::temp_directory_path() / ("natator-" + std::to_string(::getpid()) + test->name());
        std::filesystem::create_directories(directory_);
    }
    ~SceneFiles() override { std::filesystem::remove_all(directory_); }

    std::string write(const std::string& name, const std::string& text) {
        const auto path = directory_ / name;
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path) << text;
        return path.string();
    }

    std::filesystem::path directory_;
};

std::string message_of(const std::string& scene) {
    return test::refusal_of([&] { load_scene(scene); });
}

TEST(SceneTest, AllNamedScenesAreThere) {
    const std::vector<std::string> expected = {"bench/dam-break",
                                               "bench/pool",
                                               "bench/small-tank",
                                               "company/hoop",
                                               "company/pair",
                                               "company/pillars",
                                               "company/school",
                                               "endless/creature-2",
                                               "endless/eel",
                                               "endless/evolved-eel",
                                               "endless/small",
                                               "endless/water",
                                               "endless/wide-water",
                                               "goals/cruise",
                                               "goals/hold",
                                               "goals/reach",
                                               "goals/turn",
                                               "lake/creature-1",
                                               "lake/creature-2",
                                               "lake/creature-3",
                                               "lake/creature-4",
                                               "lake/eel",
                                               "lake/fry",
                                               "lake/ray",
                                               "lake/tadpole",
                                               "lake/torus",
                                               "lake/tuna",
                                               "lake/water",
                                               "open-water/creature-1",
                                               "open-water/creature-2",
                                               "open-water/creature-3",
                                               "open-water/creature-4",
                                               "open-water/eel",
                                               "open-water/periodic",
                                               "open-water/ray",
                                               "open-water/tadpole",
                                               "open-water/tuna",
                                               "open-water/water",
                                               "plane/loach",
                                               "plane/pair",
                                               "plane/street",
                                               "plane/water",
                                               "pool/creature-1",
                                               "pool/creature-2",
                                               "pool/creature-3",
                                               "pool/creature-4",
                                               "pool/eel",
                                               "pool/jellyfish",
                                               "pool/ray",
                                               "pool/tadpole",
                                               "pool/torus",
                                               "pool/tuna",
                                               "pool/turtle",
                                               "pool/water",
                                               "thesis/creature-1",
                                               "thesis/creature-1-vacuum",
                                               "thesis/creature-2",
                                               "thesis/creature-2-vacuum",
                                               "thesis/creature-3",
                                               "thesis/creature-3-vacuum",
                                               "thesis/creature-4",
                                               "thesis/creature-4-vacuum",
                                               "thesis/tank",
                                               "thesis/two-clusters",
                                               "thesis/two-clusters-vacuum"};
    EXPECT_EQ(scene_names(), expected);
}

/// Appendix A and section 2.3 of the thesis.
TEST(SceneTest, ThesisSceneHasTheValuesOfTheThesis) {
    const Scene scene = load_scene("thesis/creature-1");
    EXPECT_EQ(scene.solver.substeps, 4);
    EXPECT_EQ(scene.solver.iterations, 4);
    EXPECT_EQ(scene.solver.gravity, Eigen::Vector3d(0, -10, 0));
    EXPECT_EQ(scene.solver.radius, 0.15);
    EXPECT_EQ(scene.solver.solid_rest_distance, 0.15);
    EXPECT_EQ(scene.solver.fluid_rest_distance, 0.10);
    EXPECT_EQ(scene.solver.dynamic_friction, 0.2);
    EXPECT_EQ(scene.solver.particle_friction, 0.2);
    EXPECT_EQ(scene.solver.max_acceleration, 100);
    EXPECT_EQ(scene.solver.damping, 1);
    EXPECT_EQ(scene.solver.flex.viscosity, 8);
    EXPECT_EQ(scene.solver.flex.solidPressure, 0.1);
    EXPECT_EQ(scene.solver.collision_distance, 0.05);
    EXPECT_EQ(scene.solver.flex.relaxationMode, RelaxationMode::local);
    EXPECT_EQ(scene.duration, 4);
    EXPECT_EQ(scene.time_step, 1.0 / 60);
    ASSERT_EQ(scene.planes.size(), 5u);
    EXPECT_EQ(scene.planes[3].normal, Eigen::Vector3d(-1, 0, 0));
    EXPECT_EQ(scene.planes[3].offset, 4.51);
    EXPECT_EQ(scene.planes[4].offset, 1.54);
    EXPECT_EQ(scene.fluid->count, Eigen::Vector3i(50, 7, 17));
    EXPECT_EQ(scene.fluid->top_mass, 1.0 / 14);
    EXPECT_EQ(scene.settling.updates, 100);
    EXPECT_EQ(scene.settling.time_step, 1e-4);
    EXPECT_EQ(scene.stopping.no_progress_after, 2);
    EXPECT_EQ(scene.creature->rear_centre, Eigen::Vector3d(0.45, 0.6, 0.6));
}

TEST(SceneTest, TheSchemaThatAnEditorFindsIsNoPartOfAScene) {
    EXPECT_EQ(parse_scene(R"({"$schema":"scene.schema.json","duration":3})", "x").duration, 3);
    EXPECT_THROW(parse_scene(R"({"$schema":3})", "x"), InputError);
    EXPECT_FALSE(scene_definition("open-water/eel", json::object()).contains("$schema"));
    EXPECT_FALSE(scene_definition("open-water/eel", json::object()).at("creature").contains("$schema"));
    EXPECT_THROW(load_scene("thesis/tank", json::parse(R"({"$schema":"scene.schema.json"})")), InputError);
}

TEST(SceneTest, TheThesisTankIsTheNamedScene) {
    const Scene scene = thesis_tank(), named = load_scene("thesis/tank");
    const Model made = build_model(scene), read = build_model(named);
    EXPECT_NE(settled_state_key(made, scene.settling, 4), "");
    EXPECT_EQ(settled_state_key(made, scene.settling, 4),
              settled_state_key(read, named.settling, 4));  // all parameters, particles, planes
    EXPECT_EQ(scene.name, named.name);
    EXPECT_EQ(scene.duration, named.duration);
    EXPECT_EQ(scene.stopping.no_progress_after, named.stopping.no_progress_after);
}

TEST(SceneTest, WhatAProgramMakesIsWater) {
    Scene scene;
    scene.fluid.emplace();
    const Model water = build_model(scene);
    EXPECT_EQ(water.scheme, Scheme::conserving);
    EXPECT_EQ(water.inverse_mass, std::vector<double>(1000, 1.0));
    EXPECT_EQ(scene.fluid->spacing, scene.solver.fluid_rest_distance);
    for (const double drag : {scene.solver.damping, scene.solver.dynamic_friction, scene.solver.static_friction,
                              scene.solver.particle_friction, scene.solver.free_surface_drag})
        EXPECT_EQ(drag, 0);
}

TEST(SceneTest, AnEmptySolverHasTheDefaultsOfAppendixA) {
    const Scene scene = scene_from_json(json::parse(R"({"solver":{}})"), "x");
    const Scene thesis = load_scene("thesis/tank");
    EXPECT_EQ(scene.solver.flex.viscosity, thesis.solver.flex.viscosity);
    EXPECT_EQ(scene.solver.particle_friction, thesis.solver.particle_friction);
    EXPECT_EQ(scene.solver.max_acceleration, thesis.solver.max_acceleration);
    EXPECT_FALSE(scene.fluid);
    EXPECT_TRUE(scene.planes.empty());
}

TEST(SceneTest, VacuumHasNoFluidNoGravityNoPlanesAndNoEarlyStop) {
    for (const std::string creature : {"1", "2", "3", "4"}) {
        const Scene scene = load_scene("thesis/creature-" + creature + "-vacuum");
        EXPECT_FALSE(scene.fluid);
        EXPECT_TRUE(scene.planes.empty());
        EXPECT_EQ(scene.solver.gravity, Eigen::Vector3d(0, 0, 0));
        EXPECT_EQ(scene.solver.damping, 1);
        EXPECT_FALSE(scene.stopping.plane_contact);
        EXPECT_EQ(scene.stopping.no_progress_after, 0);
        EXPECT_EQ(scene.creature->name, "creature-" + creature);
    }
}

TEST(SceneTest, OverridesChangeOnlyWhatTheyName) {
    const Scene scene = load_scene("thesis/creature-1", json::parse(R"({
        "solver": {"particleFriction": 0, "maxAcceleration": 3.4028235e38, "relaxationMode": "global"},
        "fluid": {"mass": {"gradient": "inverse-mass-linear"}},
        "creature": {"rearCentre": [0.45, 0.3, 0.77], "springsPerParticle": 1}})"));
    EXPECT_EQ(scene.solver.particle_friction, 0);
    EXPECT_EQ(scene.solver.dynamic_friction, 0.2);
    EXPECT_EQ(static_cast<float>(scene.solver.max_acceleration), std::numeric_limits<float>::max());
    EXPECT_EQ(scene.solver.flex.relaxationMode, RelaxationMode::global);
    EXPECT_EQ(scene.fluid->gradient, MassGradient::inverse_mass_linear);
    EXPECT_EQ(scene.fluid->bottom_mass, 2);
    EXPECT_EQ(scene.creature->rear_centre, Eigen::Vector3d(0.45, 0.3, 0.77));
    EXPECT_EQ(scene.creature->springs_per_particle, 1);
    EXPECT_EQ(scene.creature->joints, (std::vector<int>{4, 8, 12}));
}

TEST(SceneTest, ACreatureCanBeSwappedAndOneCanBeGivenInPlace) {
    const Scene swapped = load_scene("thesis/creature-1", json::parse(R"({"creature":{"name":"creature-2"}})"));
    EXPECT_EQ(swapped.creature->slices.size(), 19u);
    EXPECT_EQ(swapped.creature->actuators(), 8);
    const Scene own = load_scene(
        "thesis/tank",
        json::parse(
            R"({"creature":{"name":"mine","slices":[{"height":2,"width":2,"count":3},{"height":1,"width":2}],"joints":[]}})"));
    EXPECT_EQ(own.creature->slices.size(), 4u);
    EXPECT_EQ(own.creature->slices[3].height, 1);
    EXPECT_EQ(own.creature->actuators(), 0);
}

TEST(SceneTest, NamesCannotLeaveTheDataDirectory) {
    for (const char* name : {"", "/", "../scenes/thesis/tank", "thesis//tank", "thesis/tank/", "thesis/ta nk", "."}) {
        EXPECT_NE(message_of(name).find("unknown scene"), std::string::npos) << name;
    }
}

TEST_F(SceneFiles, AFileCanBuildOnANamedScene) {
    const std::string path = write("mine.json", R"({"base":"thesis/creature-2","duration":1.5,"fluid":null})");
    const Scene scene = load_scene(path);
    EXPECT_EQ(scene.duration, 1.5);
    EXPECT_FALSE(scene.fluid);
    EXPECT_EQ(scene.planes.size(), 5u);
    EXPECT_EQ(scene.creature->name, "creature-2");
}

TEST_F(SceneFiles, ALoopOfBasesIsRefused) {
    const std::string path = (directory_ / "loop.json").string();
    write("loop.json", json{{"base", path}}.dump());
    EXPECT_NE(message_of(path).find("without a loop"), std::string::npos) << message_of(path);
}

TEST_F(SceneFiles, ABaseThatCannotBeReadIsToldWithWhoNamesIt) {
    const std::string path = write("own.json", R"({"base": "none.json"})");
    EXPECT_NE(message_of(path).find("own.json\": base: file \"none.json\": cannot be read"), std::string::npos)
        << message_of(path);
}

TEST_F(SceneFiles, UnreadableAndDamagedFilesAreNamed) {
    EXPECT_NE(message_of((directory_ / "none.json").string()).find("cannot be read"), std::string::npos);
    EXPECT_NE(message_of(directory_.string() + "/../" + directory_.filename().string() + "/x.json").find("x.json"),
              std::string::npos);
    const std::string damaged = write("damaged.json", "{\"duration\": 4,\n \"solver\": {]}");
    EXPECT_NE(message_of(damaged).find("line 2"), std::string::npos) << message_of(damaged);
    const std::string list = write("list.json", "[1]");
    EXPECT_NE(message_of(list).find("must be an object"), std::string::npos) << message_of(list);
    std::filesystem::create_directory(directory_ / "folder.json");
    EXPECT_FALSE(message_of((directory_ / "folder.json").string()).empty());
}

TEST_F(SceneFiles, TheDataDirectoryCanBeChosen) {
    write("scenes/own.json", R"({"duration": 2, "fluid": {}})");
    ::setenv("NATATOR_DATA", directory_.c_str(), 1);
    const std::vector<std::string> names = scene_names();
    const double duration = load_scene("own").duration;
    const std::string other = message_of("thesis/tank");
    ::setenv("NATATOR_DATA", "", 1);
    const std::filesystem::path usual = data_directory();
    ::unsetenv("NATATOR_DATA");
    EXPECT_EQ(usual, data_directory());
    EXPECT_EQ(names, (std::vector<std::string>{"own"}));
    EXPECT_EQ(duration, 2);
    EXPECT_NE(other.find("must be one of own"), std::string::npos) << other;
}

}  // namespace
}  // namespace natator
