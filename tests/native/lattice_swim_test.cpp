// Scheme lattice: bodies that swim in water on a lattice.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "coarse_lake.h"
#include "natator/error.h"
#include "natator/evaluate.h"
#include "natator/load_scene.h"
#include "natator/model.h"
#include "natator/simulation.h"
#include "natator/solver.h"
#include "protocol/protocol.h"
#include "refusal_of.h"
#include "run/converge/level.h"
#include "run/evaluate_frame_by_frame.h"
#include "run/perturb.h"
#include "scene/scene_json.h"

namespace natator {
namespace {

using nlohmann::json;

/// Creature 2 in a lake of coarse cells, for so long, s.
Scene lake(const json& changes = json::object(), double duration = 0.5) {
    json overrides = test::coarse_lake;
    overrides["duration"] = duration;
    overrides.merge_patch(changes);
    return load_scene("lake/creature-2", overrides);
}

/// `late`: by so many beats; half a beat later is the mirror image.
Gait wave(double late = 0) {
    Gait gait;
    gait.frequency = 2;
    for (int k = 0; k < 8; ++k) {
        gait.amplitude.push_back(0.1 + 0.05 * k);
        gait.phase.push_back(std::fmod(8 + late - 0.35 * k / 7, 1.0));
    }
    return gait;
}

Gait still() {
    return {2, std::vector<double>(8, 0), std::vector<double>(8, 0)};
}

TEST(LatticeSwim, ABodyAtRestStays) {
    const Evaluation evaluation = evaluate(lake(), still());
    EXPECT_EQ(evaluation.stopped, StopReason::completed);
    EXPECT_LT(std::abs(evaluation.distance), 1e-5);
}

/// Four cells across the body, in little water.
json fine(int substeps) {
    return {{"solver", {{"substeps", substeps}}},
            {"planes", json::array()},
            {"creature", {{"rearCentre", {0.8, 0.6, 0.6}}}},
            {"fluid",
             {{"count", {80, 32, 32}},
              {"spacing", 0.0375},
              {"origin", {0.01875, 0.01875, 0.01875}},
              {"mass", {{"bottom", 0.052734375}}}}}};
}

TEST(LatticeSwim, HalfTheTimeStepChangesLittle) {
    const double whole = evaluate(lake(fine(12), 0.75), wave()).distance,
                 half = evaluate(lake(fine(24), 0.75), wave()).distance;
    EXPECT_GT(whole, 0.02);
    EXPECT_NEAR(half, whole, 0.01);  // a quarter of a cell: where the body lies in its cells is worth as much
}

TEST(LatticeSwim, TheMirroredGaitSwimsTheMirroredWay) {
    const Evaluation one = evaluate(lake(), wave()), other = evaluate(lake(), wave(0.5));
    ASSERT_TRUE(one.course && other.course);
    EXPECT_NEAR(one.distance, other.distance, 0.02 * std::abs(one.distance));
    EXPECT_NEAR(one.course->yaw, -other.course->yaw, 0.01);
}

TEST(LatticeSwim, IsTheSameForAnyNumberOfThreads) {
    EvaluationOptions three;
    three.execution.threads = 3;
    EXPECT_EQ(evaluate(lake(json::object(), 0.2), wave()).hash,
              evaluate(lake(json::object(), 0.2), wave(), three).hash);
}

TEST(LatticeSwim, EddiesAreAddedWhereTheyAreAskedFor) {
    const json none = {{"fluid", {{"smagorinsky", 0}}}}, some = {{"fluid", {{"smagorinsky", 0.15}}}};
    EXPECT_EQ(FluidBlock{}.smagorinsky, 0);
    const auto swim = [](const json& changes, int threads) {
        EvaluationOptions options;
        options.execution.threads = threads;
        return evaluate(lake(changes, 0.2), wave(), options);
    };
    const Evaluation plain = swim(json::object(), 1), eddies = swim(some, 1);
    EXPECT_EQ(plain.hash, swim(none, 1).hash);
    EXPECT_NE(plain.hash, eddies.hash);
    EXPECT_EQ(eddies.hash, swim(some, 3).hash);
    const auto result = [](const Evaluation& of) {
        return result_json(1, of, Scheme::lattice, Precision::single_precision);
    };
    EXPECT_FALSE(result(plain).contains("smagorinsky"));
    EXPECT_EQ(result(eddies).at("smagorinsky"), 0.15);
    EXPECT_NE(describe_plan(build_model(lake(some))).back().find("Smagorinsky's constant 0.15"), std::string::npos);
    EXPECT_EQ(describe_plan(build_model(lake())).back().find("Smagorinsky"), std::string::npos);
}

TEST(LatticeSwim, EachStartIsAnother) {
    Scene first = lake(json::object(), 0.3), second = first;
    choose_start(1, first);
    choose_start(2, second);
    const double one = evaluate(first, wave()).distance, two = evaluate(second, wave()).distance;
    EXPECT_NE(one, two);
    EXPECT_NEAR(one, two, 0.01);
}

TEST(LatticeSwim, TooFewSubstepsBreakALaw) {
    const Evaluation evaluation = evaluate(lake(fine(1)), wave());
    ASSERT_TRUE(evaluation.instability);
    EXPECT_EQ(evaluation.instability->law, "mach");
    EXPECT_NE(sentence_of(*evaluation.instability).find("needs more substeps"), std::string::npos);
}

/// Of one scene, some begin in other arrangements or are perturbed, one ends early.
TEST(LatticeSwim, MembersThatGoTogetherHaveTheBitsOfEachAlone) {
    const Scene scene = lake({{"solver", {{"substeps", 8}}}, {"stopping", {{"noProgressAfter", 0}}}}, 0.3);
    Gait fast = wave(), too_fast = wave();
    fast.frequency = 2.6;
    too_fast.frequency = 20;
    for (double& amplitude : too_fast.amplitude) amplitude = 0.9;
    const std::vector<BatchMember> members{
        {wave(), {}}, {too_fast, {}}, {fast, {}, 3}, {wave(), {1e-3, 5}}, {fast, {}, 3}};
    const std::vector<Evaluation> all = evaluate_frame_by_frame(scene, members, {});
    ASSERT_EQ(all.size(), members.size());
    for (std::size_t k = 0; k < members.size(); ++k) {
        Scene own = scene;
        if (members[k].arrangement) own.fluid->disorder = *members[k].arrangement;
        const Evaluation alone = evaluate(own, members[k].gait, {.perturbation = members[k].perturbation});
        EXPECT_EQ(all[k].hash, alone.hash) << k;
        EXPECT_EQ(all[k].frames, alone.frames) << k;
        EXPECT_EQ(all[k].cells_per_step, alone.cells_per_step) << k;
    }
    EXPECT_EQ(all[1].stopped, StopReason::unstable);
    EXPECT_GT(all[1].frames, 0);
    EXPECT_EQ(all[0].stopped, StopReason::completed);
    EXPECT_NE(all[0].hash, all[3].hash);
}

TEST(LatticeSwim, TellsHowFarAPartGoesInASubstep) {
    const Evaluation coarse = evaluate(lake(fine(12)), wave()), fine_in_time = evaluate(lake(fine(24)), wave());
    EXPECT_GT(coarse.cells_per_step, 0.01);
    EXPECT_NEAR(fine_in_time.cells_per_step, coarse.cells_per_step / 2, 0.1 * coarse.cells_per_step);
    EXPECT_EQ(result_json(1, coarse, Scheme::lattice, Precision::single_precision).at("cellsPerSubstep"),
              coarse.cells_per_step);
}

TEST(LatticeSwim, AMovingTankChangesLittle) {
    const json tank = {{"movingTank", {{"step", 0.15}}}, {"stopping", {{"noProgressAfter", 9}}}};
    const Scene still_tank = lake(json::object(), 1), moving = lake(tank, 1);
    const Evaluation one = evaluate(still_tank, wave()), other = evaluate(moving, wave());
    EXPECT_NEAR(one.distance, other.distance, 0.1 * std::abs(one.distance));
}

/// It is what scenes build on.
TEST(LatticeSwim, WaterAloneIsAScene) {
    Scene water = load_scene("lake/water");
    water.duration = 0.1;
    const Model model = build_model(water);
    EXPECT_EQ(model.particles(), 0);
    EXPECT_EQ(model.water_box->cells, Eigen::Vector3i(120, 48, 48));
    for (const Precision precision : {Precision::single_precision, Precision::double_precision}) {
        const Evaluation evaluation = evaluate(water, {}, {.precision = precision});
        EXPECT_EQ(evaluation.stopped, StopReason::completed);
        EXPECT_EQ(evaluation.frames, 6);
        EXPECT_EQ(evaluation.distance, 0);
        EXPECT_FALSE(evaluation.swimming);
    }
}

/// Bodies are then as in scheme conserving, to the bit.
TEST(LatticeSwim, ThePlanNamesTheWaterBeforeAndAfterTheSolids) {
    const std::vector<std::string> plan = describe_plan(build_model(lake()));
    const auto has = [&](const char* what) {
        return std::find_if(plan.begin(), plan.end(),
                            [&](const std::string& line) { return line.find(what) != std::string::npos; });
    };
    EXPECT_LT(has("impulses of the water"), has("predict"));
    EXPECT_LT(has("velocities"), has("collision and streaming"));
    EXPECT_LT(has("collision and streaming"), plan.end());
}

TEST(LatticeSwim, NothingSwimsInVacuum) {
    Scene scene = lake();
    scene.fluid.reset();
    scene.planes.clear();
    const Evaluation evaluation = evaluate(scene, wave());
    EXPECT_EQ(evaluation.stopped, StopReason::completed);
    EXPECT_LT(std::abs(evaluation.distance), 1e-4);
    scene.scheme = Scheme::conserving;
    EXPECT_EQ(evaluate(scene, wave()).hash, evaluation.hash);
}

TEST(LatticeSwim, MusclesWork) {
    const Evaluation evaluation = evaluate(lake(), wave());
    ASSERT_TRUE(evaluation.work);
    EXPECT_GT(*evaluation.work, 0);
}

TEST(LatticeSwim, ACurrentInTheTankChangesNothingInIt) {
    const auto in = [](double current) {
        return evaluate(lake({{"movingTank", {{"step", 0.15}, {"current", {current, 0, 0}}}},
                              {"stopping", {{"noProgressAfter", 0}}}}),
                        wave());
    };
    EXPECT_EQ(in(0).hash, in(3).hash);
}

TEST(LatticeSwim, NothingSwimsInAVacuum) {
    Scene empty = lake();
    empty.fluid.reset();
    const Evaluation evaluation = evaluate(empty, wave());
    EXPECT_EQ(evaluation.stopped, StopReason::completed);
    EXPECT_LT(std::abs(evaluation.distance), 1e-4);
}

TEST(LatticeSwim, AMovingTankGoesByWholeCells) {
    const json tank = {{"movingTank", {{"step", 0.1}}}};
    const std::string refusal = test::refusal_of([&] { evaluate(lake(tank), wave()); });
    EXPECT_NE(refusal.find("step = 0.1: must be a multiple of the cells' 0.075"), std::string::npos) << refusal;
}

/// The loach with a wave to the tail, in plane flow.
const Gait loach_wave{2, {0.4, 0.35, 0.3, 0.25, 0.2}, {0, 0.902, 0.804, 0.706, 0.608}};

TEST(PlaneFlow, IsWaterOneCellDeepWithoutFloor) {
    EXPECT_TRUE(build_model(load_scene("plane/loach")).water_box->is_plane());
    EXPECT_FALSE(build_model(load_scene("lake/creature-2")).water_box->is_plane());
    const json floor = {{"creature", nullptr},
                        {"movingTank", nullptr},
                        {"planes", {{1, 0, 0, 0}, {-1, 0, 0, 3.2}, {0, 0, 1, 0}, {0, 0, -1, 1.6}, {0, 1, 0, 0}}}};
    EXPECT_FALSE(build_model(load_scene("plane/water", floor)).water_box->is_plane());
}

/// In a quarter of the time, from rest, it goes further than two tenths of its length; its particles stay in the
/// plane.
TEST(PlaneFlow, TheLoachSwimsAndStaysInItsPlane) {
    Simulation<float> swim({.scene = "plane/loach", .gait = loach_wave});
    for (int frame = 0; frame < 60; ++frame) ASSERT_TRUE(swim.step());
    EXPECT_GT(swim.distance(), 0.2);
    for (const auto& place : swim.state().position) EXPECT_EQ(place.y(), 0.01F);
}

/// Some frames before it reaches the body.
TEST(PlaneFlow, WaterThatExplodesEndsARunAsUnstable) {
    const json thin{{"duration", 1.8}, {"solver", {{"kinematicViscosity", 1e-6}}}};
    const Scene scene = load_scene("plane/loach", thin);
    const Gait gait{2, {0.4, 0.35, 0.3, 0.25, 0.2}, {0, 0.902, 0.804, 0.706, 0.608}};
    std::vector<Eigen::Vector3d> body;
    EvaluationOptions options;
    options.on_frame = [&body](double, const std::vector<Eigen::Vector3d>& places) { body = places; };
    const Evaluation result = evaluate(scene, gait, options);
    EXPECT_EQ(result.stopped, StopReason::unstable);
    EXPECT_EQ(result.fitness(), 0);
    EXPECT_TRUE(std::ranges::all_of(body, [](const Eigen::Vector3d& place) { return place.allFinite(); }));
}

/// So it is as heavy as the water in its place at either.
TEST(PlaneFlow, HalfTheCellsKeepItsDepthAndMass) {
    const Scene scene = load_scene("plane/loach", json{{"fluid", {{"disorder", 0}}}});
    const Model coarse = build_model(scene);
    const Model fine =
        build_model(load_scene("plane/loach", refined(scene, Level::named("spacing/2"), coarse.parameters.substeps)));
    EXPECT_EQ(fine.water_box->cells, Eigen::Vector3i(320, 1, 160));
    EXPECT_EQ(fine.particles(), 4 * coarse.particles());
    EXPECT_NEAR(fine.water_box->displaced_mass(fine.body.spacing), 0.25, 1e-12);
    for (const Model* model : {&coarse, &fine}) {
        EXPECT_TRUE(model->water_box->is_plane());
        EXPECT_NEAR(model->particles() / model->inverse_mass[0], coarse.particles(), 1e-9);
        EXPECT_NEAR(model->water_box->displaced_mass(model->body.spacing) * model->inverse_mass[0], 1, 1e-12);
        for (const Eigen::Vector3d& place : model->position) EXPECT_EQ(place.y(), 0.01);
    }
}

TEST(PlaneFlow, ShiftsNothingOutOfTheMiddle) {
    Model model = build_model(load_scene("plane/loach"));
    perturb({0.001, 1}, model);
    for (const Eigen::Vector3d& place : model.position) EXPECT_EQ(place.y(), 0.01);
}

TEST(PlaneFlow, RefusesWhatIsNotPlane) {
    const auto refusal = [](const json& creature) {
        return test::refusal_of([&] { build_model(load_scene("plane/loach", json{{"creature", creature}})); });
    };
    EXPECT_EQ(refusal({{"rearCentre", {1.8, 0.02, 0.8}}}),
              "scene \"plane/loach\": scheme lattice: creature.rearCentre[1] = 0.02: must be 0.01, the middle "
              "(fluid.origin) of water that is one cell deep");
    EXPECT_EQ(
        refusal({{"slices", {{{"height", 2}, {"width", 4}, {"count", 30}}}}, {"joints", {10, 20}}, {"spacing", 0.02}}),
        "scene \"plane/loach\": scheme lattice: creature.slices[0].height = 2: must be 1 in water that is one "
        "cell deep");
    EXPECT_EQ(
        test::refusal_of([] { build_model(load_scene("plane/loach", json{{"solver", {{"gravity", {0, -1, 0}}}}})); }),
        "scene \"plane/loach\": scheme lattice: solver.gravity[1] = -1: must be 0 in water that is one cell deep");
}

TEST(LatticeSwim, RefusesWhatItHasNot) {
    const auto refusal = [](const json& changes) { return test::refusal_of([&] { build_model(lake(changes)); }); };
    EXPECT_NE(refusal({{"solver", {{"kinematicViscosity", 0}}}}).find("kinematicViscosity = 0: must be above 0"),
              std::string::npos);
    EXPECT_NE(refusal({{"solver", {{"kinematicViscosity", 6}}}}).find("kinematicViscosity = 6: must be at most 5.4"),
              std::string::npos);
    Scene empty = lake();
    empty.creature.reset();
    empty.fluid.reset();
    EXPECT_NE(test::refusal_of([&] { build_model(empty); }).find("needs a creature or fluid"), std::string::npos);
    EXPECT_NE(refusal({{"planes", {{0, 1, 0, 0.3}}}}).find("planes[0] stands at -0.3: must be at the fluid's end, 0"),
              std::string::npos);
    EXPECT_NE(refusal({{"planes", {{0.6, 0.8, 0, 0}}}}).find("square across an axis"), std::string::npos);
    EXPECT_NE(refusal({{"fluid", {{"mass", {{"gradient", "mass-linear"}}}}}}).find("must be uniform"),
              std::string::npos);
}

}  // namespace
}  // namespace natator
