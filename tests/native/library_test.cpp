// What a program that uses the library relies on: the umbrella header alone, lifetimes, data without an environment.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <type_traits>

#include "natator/natator.h"
#include "refusal_of.h"

namespace natator {
namespace {

namespace fs = std::filesystem;

template <class AnySolver>
constexpr bool keeps_no_temporary =
    std::is_constructible_v<AnySolver, Model&> && std::is_constructible_v<AnySolver, const Model&> &&
    !std::is_constructible_v<AnySolver, Model> && !std::is_constructible_v<AnySolver, const Model>;
static_assert(keeps_no_temporary<Solver<float>> && keeps_no_temporary<Solver<double>>);

std::string message_of(const std::string& name, const SceneOptions& options) {
    return test::refusal_of([&] { load_scene(name, options); });
}

/// A folder with a scene and a creature of its own.
class LibraryTest : public testing::Test {
protected:
    LibraryTest()
        : data_(fs::path(testing::TempDir()) /
                ("natator-" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()))) {
        fs::create_directories(data_ / "scenes" / "my");
        fs::create_directories(data_ / "creatures");
        std::ofstream(data_ / "scenes" / "my" / "base.json") << R"({"duration": 3, "fluid": {"count": [2, 2, 2]}})";
        std::ofstream(data_ / "scenes" / "my" / "pool.json") << R"({"base": "my/base", "creature": {"name": "eel"}})";
        std::ofstream(data_ / "creatures" / "eel.json")
            << R"({"slices": [{"height": 2, "width": 2}, {"height": 2, "width": 2}], "joints": []})";
    }
    ~LibraryTest() override { fs::remove_all(data_); }

    const fs::path data_;
};

TEST_F(LibraryTest, ScenesAndCreaturesComeFromTheFolderThatIsNamed) {
    EXPECT_EQ(scene_names(data_), (std::vector<std::string>{"my/base", "my/pool"}));
    const Scene scene = load_scene("my/pool", {.data = data_});
    EXPECT_EQ(scene.duration, 3);
    ASSERT_TRUE(scene.creature);
    EXPECT_EQ(scene.creature->slices.size(), 2u);
    EXPECT_NE(message_of("thesis/creature-1", {.data = data_}).find("must be one of my/base, my/pool"),
              std::string::npos);
    const std::string nowhere = message_of("pool", {.data = data_ / "none"});
    EXPECT_NE(nowhere.find("none found in \"" + (data_ / "none" / "scenes").string() + "\""), std::string::npos)
        << nowhere;
    Simulation<float> live({.scene = "my/base", .data = data_});
    EXPECT_EQ(live.model().particles(), 8);
}

TEST_F(LibraryTest, WithoutAFolderScenesAreBesideTheProgram) {
    EXPECT_EQ(data_directory(), fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "share" / "natator");
    EXPECT_EQ(scene_names(), scene_names(data_directory()));
    EXPECT_TRUE(load_scene("thesis/creature-1").creature);
}

TEST_F(LibraryTest, AFileNamesOthersFromWhereItIs) {
    std::ofstream(data_ / "base.json") << R"({"duration": 2, "fluid": {"count": [2, 2, 2]}})";
    std::ofstream(data_ / "body.json") << R"({"slices": [{"height": 2, "width": 2, "count": 3}], "joints": []})";
    std::ofstream(data_ / "scene.json")
        << R"({"base": "base.json", "creature": {"name": "body.json"}, "companions": [{"creature": {"name": "./body.json"}}]})";
    const Scene scene = load_scene((data_ / "scene.json").string(), {.data = data_});
    EXPECT_EQ(scene.duration, 2);
    EXPECT_EQ(scene.creature->slices.size(), 3u);
    EXPECT_EQ(scene.companions.at(0).creature.slices.size(), 3u);
}

TEST_F(LibraryTest, OverridesAreText) {
    EXPECT_EQ(load_scene("my/base", {.overrides = R"({"duration": 1, "fluid": null})", .data = data_}).duration, 1);
    EXPECT_EQ(message_of("my/base", {.overrides = "{\"duration\":", .data = data_})
                  .find("scene \"my/base\": overrides: not valid JSON: "),
              0u);
    EXPECT_EQ(message_of("my/base", {.overrides = "[1]", .data = data_})
                  .find("scene \"my/base\": overrides = [1]: must be an object"),
              0u);
    EXPECT_EQ(parse_scene(R"({"duration": 2, "fluid": {}})", "mine").duration, 2);
    EXPECT_THROW(parse_scene(R"({"duration": 0})", "mine"), InputError);
    EXPECT_THROW(parse_scene(R"({"base": "my/base"})", "mine"), InputError);
}

TEST_F(LibraryTest, WithoutAGpuASolverOnItSaysSo) {
    if (!cuda_devices().empty()) GTEST_SKIP() << "there is a GPU";
    const Model model = build_model(load_scene("my/base", {.data = data_}));
    EXPECT_THROW(Solver<float>(model, {.gpu = 0}), NoDevice);
    EXPECT_THROW(Simulation(load_scene("my/base", {.data = data_}), {.gpu = 0}), NoDevice);
    EXPECT_THROW(evaluate_on_gpu(load_scene("my/base", {.data = data_}), {BatchMember{}}), NoDevice);
}

/// A body of twelve slices with three joints.
Scene own_scene() {
    Scene scene;
    scene.scheme = Scheme::flex;
    Creature& creature = scene.creature.emplace();
    creature.slices.assign(12, Slice{.height = 3, .width = 3});
    creature.joints = {3, 6, 9};
    return scene;
}

/// Some water of scheme `conserving`, far from the swimmer.
Scene& make_water(Scene& scene) {
    scene.scheme = Scheme::conserving;
    scene.fluid = FluidBlock{.count = {2, 2, 2}, .origin = {5, 5, 5}};
    return scene;
}

/// What a program makes no reader has checked: it would read beyond the ends of lists.
TEST(OwnSceneTest, WhatDoesNotFitTogetherIsRefused) {
    const std::pair<void (*)(Scene&), const char*> changes[] = {
        {[](Scene&) {}, ""},
        {[](Scene& scene) { scene.creature->joints = {3, 99}; }, "creature.joints[1] = 99: must be a slice in [4, 10]"},
        {[](Scene& scene) { scene.creature->joints = {6, 3}; }, "creature.joints[1] = 3: must be a slice in [7, 10]"},
        {[](Scene& scene) { scene.creature->muscle_slices = {-1, 5}; }, "creature.muscleSlices[0] = -1: must be"},
        {[](Scene& scene) { scene.creature->slices.clear(); }, "creature.slices = 0: must be at least one slice"},
        {[](Scene& scene) { scene.creature->slices[1].width = -1; },
         "creature.slices[1].width = -1: must be at least 1"},
        {[](Scene& scene) { scene.creature->slices[1].rows = {3}; },
         "creature.slices[1].rows has length 1: must have length 3"},
        {[](Scene& scene) { scene.creature->spring_stiffnesses = {1}; },
         "creature.springStiffness has length 1: must have length 2"},
        {[](Scene& scene) { scene.creature->refinement = 0; }, "creature.refinement = 0: must be at least 1"},
        {[](Scene& scene) { scene.companions.push_back({Creature(), Gait()}); },
         "companions[0].creature.slices = 0: must be"},
        {[](Scene& scene) { scene.fluid = FluidBlock{.count = {-5, -5, 5}}; }, "fluid.count = -5: must be at least 1"},
        {[](Scene& scene) { scene.fluid = FluidBlock{.count = {2000000000, 2000000000, 2000000000}}; },
         "must be at most 16000000"},
        {[](Scene& scene) { scene.fluid = FluidBlock{.spacing = 0}; },
         "fluid.spacing = 0: must be a finite number above 0"},
        {[](Scene& scene) { scene.solver.radius = NAN; },
         "solver.radius = NaN: must be a number in (0, 1000] (length)"},
        {[](Scene& scene) { scene.creature->refinement = 65536; },
         "creature.spacing = 0.075: must be at least 0.01 at 65536 times"},
        {[](Scene& scene) {
             scene.scheme = Scheme::conserving;
             scene.planes.clear();
             scene.creature->refinement = 65536;
         },
         "30399297484750848 particles"},
        {[](Scene& scene) { scene.creature->slices[0] = {.height = 65536, .width = 65536}; }, "4294967395 particles"},
        {[](Scene& scene) { scene.duration = NAN; }, "duration = NaN: must be a finite number of at least 0"},
        {[](Scene& scene) { scene.obstacles.emplace_back().radius = NAN; },
         "obstacles[0].radius = NaN: must be a finite number above 0"},
        {[](Scene& scene) { scene.solver.substeps = 0; }, "solver.substeps = 0: must be a whole number in [1, 1000]"},
        {[](Scene& scene) { scene.solver.gravity.y() = NAN; },
         "solver.gravity[1] = NaN: must be a number in [-1000, 1000] (length/s^2)"},
        {[](Scene& scene) { scene.solver.conserving.kinematic_viscosity = NAN; },
         "solver.kinematicViscosity = NaN: must be a number in [0, 1000]"},
        {[](Scene& scene) { scene.solver.solid_rest_distance = 0.2; },
         "solver.solidRestDistance = 0.2: must be at most radius = 0.15"},
        {[](Scene& scene) { scene.solver.radius = 1000; },
         "solver.fluidRestDistance = 0.1: must be at least radius / 20, radius = 1000"},
        {[](Scene& scene) { scene.solver.max_speed = scene.solver.max_acceleration = INFINITY; }, ""},
        {[](Scene& scene) { scene.planes = {{{0, 1, 0}, 0}, {{0, 2, 0}, 1}}; },
         "planes[1] = [0.0,2.0,0.0,1.0]: must be [a, b, c, d] with (a,"},
        {[](Scene& scene) { scene.planes = {{{0, 1, 0}, NAN}}; },
         "planes[0][3] = NaN: must be a finite number (length)"},
        {[](Scene& scene) { scene.settling.substeps = 0; }, "settling.substeps = 0: must be at least 1"},
        {[](Scene& scene) { make_water(scene).solver.conserving.kinematic_viscosity = 1; },
         "solver.kinematicViscosity = 1.0: must be at most 0.24 (0.1"},
        {[](Scene& scene) { make_water(scene).planes = {{{0, 1, 0}, 0}, {{0.6, 0.8, 0}, 9}}; },
         "planes[1] = [0.6,0.8,0.0,9.0]: must be at a right angle to planes[0] or facing it, in scheme conserving"},
        {[](Scene& scene) { scene.solver.conserving.kernel_support = 1e6; },
         "solver.kernelSupport = 1000000.0: must be a number in [2, 4] (rest"},
    };
    for (const auto& [change, expected] : changes) {
        Scene scene = own_scene();
        change(scene);
        const std::string message = test::refusal_of([&] { build_model(scene); });
        EXPECT_NE(message.find(expected), std::string::npos) << message;
        EXPECT_EQ(message.empty(), *expected == '\0') << message << expected;
    }
}

/// Two particles and a spring, a cluster and a muscle, as a program may make them without a scene.
Model own_model() {
    Model model;
    model.scheme = Scheme::flex;
    for (const double x : {0.0, 0.1}) {
        model.position.emplace_back(x, 1, 0);
        model.velocity.emplace_back(0, 0, 0);
        model.inverse_mass.push_back(1);
        model.phase.push_back(1);
    }
    model.springs = {{.a = 0, .b = 1, .rest_length = 0.1}};
    model.clusters = {{.particles = {0, 1}, .rest_offset = {{-0.05, 0, 0}, {0.05, 0, 0}}}};
    model.muscles = {{.spring = 0, .actuator = 0, .lateral = 1}};
    model.actuators = 1;
    return model;
}

TEST(OwnSceneTest, ASolverRefusesAModelWhoseListsDoNotBelongTogether) {
    const std::pair<void (*)(Model&), const char*> changes[] = {
        {[](Model&) {}, ""},
        {[](Model& model) { model.velocity.pop_back(); }, "model: velocity has length 1: must have length 2"},
        {[](Model& model) { model.phase.clear(); }, "model: phase has length 0: must have length 2"},
        {[](Model& model) { model.springs[0].b = 2; }, "model: springs[0].b = 2: must be one of 2, numbered from 0"},
        {[](Model& model) { model.clusters[0].particles[1] = -1; },
         "model: clusters[0].particles[1] = -1: must be one of 2"},
        {[](Model& model) { model.clusters[0].rest_offset.clear(); }, "model: clusters[0].rest_offset has length 0"},
        {[](Model& model) { model.muscles[0].spring = 1; }, "model: muscles[0].spring = 1: must be one of 1"},
        {[](Model& model) { model.actuators = -1; }, "model: actuators = -1: must be at least 0"},
        {[](Model& model) { model.periodic = {{.axis = 7, .low = -1, .high = 1}}; },
         "model: periodic[0].axis = 7: must be one of 3"},
        {[](Model& model) { model.body.slices = {{0}, {2}}; }, "model: body.slices[1][0] = 2: must be one of 2"},
        {[](Model& model) {
             model.companions.emplace_back().first_actuator = 1;
             model.companions.back().body.particles = {2};
         },
         "model: companions[0].body.particles[0] = 2: must be"},
        {[](Model& model) { model.companions.emplace_back().gait.amplitude = {1}; },
         "model: companions[0].gait.phase has length 0"},
        {[](Model& model) {
             model.companions.emplace_back().gait = {.amplitude = {1}, .phase = {0}, .offset = {0, 0}};
         },
         "model: companions[0].gait.offset has length 2"},
        {[](Model& model) { model.companions.emplace_back(); },
         "model: companions[0].first_actuator = 0: must be 1, the number of actuators before"},
        {[](Model& model) {
             model.companions.emplace_back().first_actuator = 1;
             model.companions.back().first_spring = 2;
         },
         "model: companions[0].first_spring = 2: must be in [0, 1]"},
        {[](Model& model) { model.actuators = 0; }, "model: muscles[0].actuator = 0: must be one of 0"},
        {[](Model& model) { model.parameters.conserving.kernel_support = 1e6; },
         "model: parameters.kernelSupport = 1e+06: must be a number in [2, 4] (rest distances of the fluid)"},
        {[](Model& model) { model.parameters.conserving.kernel_support = 1.999; },
         "model: parameters.kernelSupport = 1.999: must be"},
        {[](Model& model) { model.parameters.conserving.kernel_support = NAN; },
         "model: parameters.kernelSupport = NaN: must be"},
        {[](Model& model) { model.parameters.fluid_rest_distance = 1e-6; },
         "model: parameters.fluidRestDistance = 1e-06: must be at least radius / 20, radius = 0.15"},
        {[](Model& model) { model.parameters.conserving.kernel_support = 4; }, ""},
    };
    for (const auto& [change, expected] : changes) {
        Model model = own_model();
        change(model);
        EXPECT_EQ(test::refusal_of([&] { initial_state<float>(model); }),
                  test::refusal_of([&] { const Solver<float> solver(model); }));
        const std::string message = test::refusal_of([&] { initial_state<float>(model); });
        EXPECT_NE(message.find(expected), std::string::npos) << message;
        EXPECT_EQ(message.empty(), *expected == '\0') << message << expected;
    }
}

TEST(OwnSceneTest, ASolverRefusesAGaitADriveAndAStateOfAnotherModel) {
    for (const Scheme scheme : {Scheme::flex, Scheme::conserving}) {
        Scene scene = own_scene();
        scene.scheme = scheme;
        const Model model = build_model(scene);
        Solver<float> solver(model);
        State<float> state = initial_state<float>(model);
        EXPECT_EQ(test::refusal_of([&] { solver.frame(state, resting_gait(2)); }), "");
        EXPECT_NE(test::refusal_of([&] {
                      solver.frame(state, Gait{});
                  }).find("gait.amplitude has length 0: must have length 2"),
                  std::string::npos);
        EXPECT_NE(test::refusal_of([&] {
                      solver.frame(state, Gait{.amplitude = {1, 1}, .phase = {0}});
                  }).find("gait.phase has length 1"),
                  std::string::npos);
        EXPECT_NE(test::refusal_of([&] {
                      solver.frame(state, [](double) { return std::vector<double>{1}; });
                  }).find("drive has length 1"),
                  std::string::npos);
        EXPECT_NE(test::refusal_of([&] {
                      solver.frame(state, [](double) { return std::vector<double>{0, NAN}; });
                  }).find("drive[1] = NaN: must be a number in [-2, 2]"),
                  std::string::npos);
        EXPECT_NE(test::refusal_of([&] {
                      Solver<float>(model, {.threads = 1025});
                  }).find("threads = 1025: must be at most 1024"),
                  std::string::npos);
        EXPECT_NE(test::refusal_of([&] { solver.update(state, 0.01, 0); }).find("substeps = 0: must be at least 1"),
                  std::string::npos);
        EXPECT_NE(test::refusal_of([&] {
                      solver.update(state, NAN, 1);
                  }).find("time step = NaN: must be a finite number above 0"),
                  std::string::npos);
        EXPECT_NE(test::refusal_of([&] { solver.update(state, -0.01, 1); }).find("time step = -0.01: must be"),
                  std::string::npos);
        state.position.pop_back();
        EXPECT_NE(test::refusal_of([&] { solver.update(state, 0.01, 1); }).find("must have 108, 4, "),
                  std::string::npos);
    }
}

TEST(OwnSceneTest, WhatIsMeasuredOfAStateOfAnotherModelIsRefused) {
    const Model model = build_model(own_scene());
    State<float> other;
    const auto refuses = [](const auto& call) { return !test::refusal_of(call).empty(); };
    EXPECT_TRUE(refuses([&] { actuate(model, resting_gait(2), 0, other); }));
    EXPECT_TRUE(refuses([&] { sense(model, other, {}); }));
    EXPECT_TRUE(refuses([&] { touches_plane(model, other); }));
    EXPECT_TRUE(refuses([&] { measure_momentum(model, other); }));
    EXPECT_TRUE(refuses([&] { centre_velocity(model, other, {0}); }));
    const State<float> own = initial_state<float>(model);
    EXPECT_NE(test::refusal_of([&] {
                  measure_momentum(model, own, {0, model.particles()});
              }).find("particles[1] = 108: must be one of 108"),
              std::string::npos);
    EXPECT_TRUE(refuses([&] { centre_velocity(model, own, {-1}); }));
    EXPECT_TRUE(refuses([&] { course_of(model, model.body, other, 0); }));
    EXPECT_TRUE(refuses([&] { cavities(model, other, {}); }));
    EXPECT_TRUE(refuses([&] { pose_of(model, model.body, std::vector<Eigen::Vector3d>(109)); }));
    EXPECT_TRUE(refuses([&] { body_rotation(model, model.body, {}); }));
    EXPECT_TRUE(refuses([&] { cavities(model, initial_state<float>(model), {}); }));
    EXPECT_TRUE(refuses([&] { write_snapshot(testing::TempDir() + "other.csv", model, Snapshot{}); }));
    TrajectoryCsv path(testing::TempDir() + "path.csv", own_scene().creature->slices, TrajectoryCsv::Rows::slices);
    EXPECT_TRUE(refuses([&] { path.add_frame(0, std::vector<Eigen::Vector3d>(50)); }));
}

TEST(OwnSceneTest, SteeringOfAnotherLengthAndAStartBelow0AreRefused) {
    EXPECT_NE(test::refusal_of([] {
                  steer(no_steering(2), no_steering(1), 0.5, {1, 1});
              }).find("scale has length 1: must have length 2"),
              std::string::npos);
    EXPECT_NE(test::refusal_of([] { check_steering(no_steering(2), Gait{}, 2); }).find("gait.amplitude has length 0"),
              std::string::npos);
    Scene scene = own_scene();
    EXPECT_NE(test::refusal_of([&] {
                  choose_start(-1, scene);
              }).find("start = -1: must be a whole number in [0, 2147483647]"),
              std::string::npos);
}

}  // namespace
}  // namespace natator
