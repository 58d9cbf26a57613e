// The studies behind `natator-sim bench`: their figures on synthetic data, quick runs of each, and resumption.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "ensemble.h"
#include "front_error.h"
#include "natator/error.h"
#include "natator/measure.h"
#include "natator/model.h"
#include "natator/solver.h"
#include "physics/constants.h"
#include "precision.h"
#include "references.h"
#include "run/converge/estimate.h"
#include "run/settle.h"
#include "scene/scene_json.h"
#include "speed.h"
#include "stability.h"
#include "statistics.h"
#include "throughput.h"
#include "validation.h"

namespace natator::bench {
namespace {

void ignore(const std::string&) {}

/// A path in the temporary folder, freed at the end.
struct TemporaryPath {
    explicit TemporaryPath(const std::string& name)
        : path((std::filesystem::temp_directory_path() / ("natator-" + std::to_string(::getpid()) + name)).string()) {}
    ~TemporaryPath() { std::filesystem::remove(path); }
    std::string path;
};

std::string content(const std::string& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(StatisticsTest, OrderIsTheExponentOfAPowerLaw) {
    const std::vector<double> n{4, 8, 16, 32};
    std::vector<double> errors;
    for (const double value : n) errors.push_back(0.3 * std::pow(value, -1.5));
    EXPECT_NEAR(convergence_order(n, errors).value(), 1.5, 1e-12);
}

TEST(StatisticsTest, OrderLeavesOutWhatHasNoLogarithm) {
    EXPECT_NEAR(convergence_order({1, 2, 4, 8}, {1, 0.5, 0, std::nan("")}).value(), 1, 1e-12);
    EXPECT_FALSE(convergence_order({1, 2}, {1, 0}));
    EXPECT_FALSE(convergence_order({2, 2, 2}, {1, 2, 3}));
    EXPECT_FALSE(convergence_order({}, {}));
}

TEST(StatisticsTest, ParetoFrontHoldsWhatNothingBeats) {
    const std::vector<WorkPoint> points{{4, 1}, {1, 9}, {2, 9}, {3, 2}, {5, 3}, {1, 9}};
    EXPECT_EQ(pareto_front(points), (std::vector<std::size_t>{1, 3, 0}));
    EXPECT_TRUE(pareto_front({}).empty());
}

TEST(StatisticsTest, MedianAndSpread) {
    EXPECT_EQ(median({3, 1, 2}), 2);
    EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
    EXPECT_NEAR(spread({1, 2, 3, 4}).deviation, std::sqrt(5.0 / 3), 1e-15);
    EXPECT_EQ(spread({7}).deviation, 0);
}

TEST(ResultTableTest, GoesOnWhereAKilledStudyStopped) {
    const TemporaryPath file("-table.csv");
    {
        ResultTable(file.path, {"a", "b"}, 1).add({"1", "x"});
    }
    std::ofstream(file.path, std::ios::app) << "2,cut o";
    ResultTable table(file.path, {"a", "b"}, 1);
    EXPECT_TRUE(table.has({"1"}));
    EXPECT_FALSE(table.has({"2"}));
    table.add({"2", "y"});
    EXPECT_TRUE(table.has({"2"}));
    EXPECT_EQ(content(file.path), "a,b\n1,x\n2,y\n");
    EXPECT_EQ(table.text(), content(file.path));
    EXPECT_THROW(ResultTable(file.path, {"a", "c"}, 1), InputError);
    for (const char* text : {"", "a", "a,b"}) {  // killed before the first row
        std::ofstream(file.path, std::ios::trunc) << text;
        EXPECT_NO_THROW(ResultTable(file.path, {"a", "b"}, 1)) << text;
    }
    std::ofstream(file.path, std::ios::trunc) << "somebody's notes, without a line break";
    EXPECT_THROW(ResultTable(file.path, {"a", "b"}, 1), InputError);
    EXPECT_EQ(content(file.path), "somebody's notes, without a line break");
}

TEST(ResultTableTest, SaysHowManyRowsItFoundDone) {
    const TemporaryPath file("-table.csv");
    ResultTable(file.path, {"a"}, 1).add({"1"});
    testing::internal::CaptureStderr();
    {
        ResultTable table(file.path, {"a"}, 1);
        for (const char* key : {"1", "1", "2"})
            if (!table.has({key})) table.add({key});
        EXPECT_TRUE(table.has({"2"})) << "its own";
    }
    EXPECT_EQ(
        testing::internal::GetCapturedStderr(),
        file.path + ": holds 1 of these rows already, which are kept; with another file they are measured again\n");
}

TEST(ResultTableTest, NumbersReadBack) {
    EXPECT_EQ(number_text(0.1), "0.1");
    EXPECT_EQ(measured_text(1.0 / 3), "0.333333");
    EXPECT_EQ(number_text(std::nan("")), "");
    EXPECT_EQ(path_beside("results/precision.csv", "orders"), "results/precision-orders.csv");
}

TEST(BenchScenesTest, AllAreBuilt) {
    for (const std::string& name : subject_names()) {
        const Subject subject = make_subject(name);
        EXPECT_GT(subject.model.particles(), 0) << name;
        EXPECT_EQ(subject.gait.amplitude.size(), static_cast<std::size_t>(subject.model.actuators)) << name;
    }
    EXPECT_THROW(make_subject("bathtub"), InputError);
}

/// Two particles of masses 1 and 2 with opposite momenta at distance 3: nothing is left over but the spin.
TEST(MomentumTest, OppositeMomentaLeaveTheSpin) {
    Model model;
    model.position = {{0, 0, 0}, {3, 0, 0}};
    model.inverse_mass = {1, 0.5};
    State<double> state;
    state.position = model.position;
    state.velocity = {{0, 2, 0}, {0, -1, 0}};
    const Momentum momentum = measure_momentum(model, state);
    EXPECT_NEAR(momentum.linear, 0, 1e-15);
    EXPECT_NEAR(momentum.angular, 6, 1e-14);
    EXPECT_NEAR(momentum.linear_size, 4, 1e-15);
}

TEST(PrecisionTest, QuickStudyGivesFiniteRowsAndGoesOn) {
    const TemporaryPath file("-precision.csv");
    PrecisionStudy study{{"hanging-chain", "bending-body"},
                         {Scheme::flex, Scheme::conserving},
                         {Precision::single_precision, Precision::double_precision},
                         {4, 8},
                         {2},
                         1};
    ResultTable table(file.path, precision_columns(), precision_key_columns);
    run_precision_study(study, table, ignore);
    ASSERT_EQ(table.rows().size(), 16u);
    for (const Row& row : table.rows()) {
        EXPECT_EQ(row[5], "ok");
        for (const std::size_t column : {7u, 8u, 9u}) EXPECT_GT(std::stod(row[column]), 0) << joined(row, " ");
        if (row[0] == "bending-body" && row[1] == "conserving") {
            EXPECT_LT(std::stod(row[13]), 1e-5);
        }
    }
    EXPECT_EQ(convergence_orders(table.rows()).rows().size(), 4u);
    EXPECT_NE(pareto_text(table.rows()).find("hanging-chain conserving"), std::string::npos);

    study.substeps = {4, 8, 16};
    study.scenes = {"hanging-chain"};
    ResultTable again(file.path, precision_columns(), precision_key_columns);
    run_precision_study(study, again, ignore);
    EXPECT_EQ(again.rows().size(), 20u);
    EXPECT_EQ(again.rows().front(), table.rows().front());
}

TEST(EnsembleTest, SummaryIsTheMeanOfTheSeeds) {
    EnsembleStudy study;
    study.creatures = {1};
    study.settings = {{Scheme::conserving, Precision::single_precision, 1, 1}};
    study.runs = 2;
    study.duration = 2.0 / 60;
    ResultTable table("", ensemble_columns(), ensemble_key_columns);
    run_ensemble_study(study, table, ignore);
    ASSERT_EQ(table.rows().size(), 2u);
    EXPECT_NE(table.rows()[0][8], table.rows()[1][8]);
    const ResultTable summary = ensemble_summary(table.rows());
    ASSERT_EQ(summary.rows().size(), 1u);
    EXPECT_NEAR(std::stod(summary.rows()[0][6]), (std::stod(table.rows()[0][7]) + std::stod(table.rows()[1][7])) / 2,
                1e-6);
}

TEST(SpeedTest, QuickStudyHasAHashAndAProfilePerRow) {
    const SpeedStudy study{speed_scenes_at({"creature-1", "vacuum"}, {}),
                           {Scheme::flex, Scheme::conserving},
                           {Precision::single_precision},
                           {1},
                           2,
                           true};
    ResultTable table("", speed_columns(), speed_key_columns);
    ResultTable profile("", speed_profile_columns(), speed_key_columns);
    run_speed_study(study, table, profile, ignore);
    ASSERT_EQ(table.rows().size(), 4u);
    for (const Row& row : table.rows()) {
        for (const std::size_t column : {11u, 12u, 13u, 14u}) EXPECT_GT(std::stod(row[column]), 0) << joined(row, " ");
        EXPECT_EQ(row[15].size(), 16u);
        double share = 0;
        for (const Row& stage : profile.rows())
            if (std::equal(row.begin(), row.begin() + speed_key_columns, stage.begin())) share += std::stod(stage[9]);
        EXPECT_NEAR(share, 1, 1e-4) << joined(row, " ");
    }
    EXPECT_EQ(table.rows()[0][7], "5660");
    EXPECT_EQ(table.rows()[2][7], "0");
    EXPECT_NE(table.rows()[0][15], table.rows()[1][15]);
}

TEST(SpeedTest, ASettingTakesThePlaceOfTheScenesSteps) {
    const std::vector<SpeedScene> scenes = speed_scenes_at({"creature-1", "vacuum"}, {"1x4m", "2x3"});
    std::vector<std::string> names;
    for (const SpeedScene& scene : scenes) names.push_back(scene.text());
    EXPECT_EQ(names, (std::vector<std::string>{"creature-1 1x4m", "creature-1 2x3", "vacuum 1x4m", "vacuum 2x3"}));
    const Scene scene = make_speed_scene(scenes[1], true);
    EXPECT_EQ(scene.solver.substeps, 2);
    EXPECT_EQ(scene.solver.iterations, 3);
    EXPECT_EQ(make_speed_scene({"creature-1"}, true).solver.substeps, 4);
    EXPECT_EQ(speed_scenes_at({"vacuum"}, {}).front().text(), "vacuum");
    EXPECT_FALSE(scene.solver.conserving.modified_pressure);
    EXPECT_TRUE(make_speed_scene(scenes[0], true).solver.conserving.modified_pressure);
    for (const char* setting : {"2", "2x4w", "2x4mm", "x4m", "2x4 m2"})
        EXPECT_THROW(speed_scenes_at({"vacuum"}, {"2x4", setting}), InputError) << setting;
}

TEST(SpeedTest, ProfilingChangesNoBit) {
    Scene scene = load_scene("thesis/creature-1", nlohmann::json{{"duration", 0.02}});
    StageProfile profile;
    const Evaluation plain = evaluate(scene, thesis_gait(1));
    const Evaluation profiled = evaluate(scene, thesis_gait(1), {.execution = {.profile = &profile}});
    EXPECT_EQ(plain.hash, profiled.hash);
    EXPECT_GT(profile.seconds(), 0);
    EXPECT_EQ(profile.entries().front().stage, "predict");
}

int fluid_of(const Model& model) {
    int fluid = 0;
    for (int i = 0; i < model.particles(); ++i) fluid += model.is_fluid(i);
    return fluid;
}

TEST(ThroughputTest, TanksHaveTheirParticlesBetweenTheirWalls) {
    for (const int particles : {1000, 2000, 5660, 16000, 64000, 125000}) {
        const Scene scene = throughput_scene(particles);
        const Model model = build_model(scene);
        const int across = scene.fluid->count.y() * scene.fluid->count.z();
        EXPECT_NEAR(fluid_of(model), particles, std::max(across / 2.0, 500.0 * (across > 1000))) << particles;
        EXPECT_EQ(fluid_of(model) + 255, model.particles()) << "the swimmer";
        double nearest = 1;
        std::vector<int> rests_on(model.planes.size(), 0);
        for (const Eigen::Vector3d& place : model.position)
            for (std::size_t k = 0; k < model.planes.size(); ++k) {
                nearest = std::min(nearest, model.planes[k].distance(place));
                rests_on[k] += model.planes[k].distance(place) < 0.051;
            }
        EXPECT_NEAR(nearest, 0.05, 1e-9) << particles;
        for (const int resting : rests_on) EXPECT_GT(resting, 0) << "a wall stands off the water";
    }
}

/// Else their time would go to parting overlaps, which water so deep has for longer if it begins at the thesis'
/// spacing.
TEST(ThroughputTest, TanksHaveNoOverlapsOnceSettled) {
    Scene scene = throughput_scene(64000);
    scene.scheme = Scheme::conserving;
    const Model model = build_model(scene);
    Solver<float> solver(model);
    State<float> state = initial_state<float>(model);
    ASSERT_FALSE(settle(scene.settling, solver, state));
    const std::vector<float> densities = solver.densities();
    EXPECT_LT(*std::max_element(densities.begin(), densities.end()), 1 + physics::overlap_tolerance);
}

TEST(ThroughputTest, BatchesTakeAboutTheSameTime) {
    EXPECT_EQ(throughput_frames(Scheme::flex, 1000, 1), 240);
    EXPECT_EQ(throughput_frames(Scheme::flex, 1'000'000, 1), 63);
    EXPECT_EQ(throughput_frames(Scheme::conserving, 16'000, 150), 5);
    EXPECT_EQ(throughput_frames(Scheme::conserving, 10'000'000, 1), 4);
}

/// Shocks, extremes and the calm case: each run ends, with finite figures, as ok or with the law that it breaks.
TEST(StabilityTest, QuickSweepGivesFiniteRows) {
    const StabilityStudy study{{Scheme::flex, Scheme::conserving},
                               {Precision::single_precision},
                               {"dt", "gravity", "overlap", "coincident", "outside", "radius-ratio"},
                               true};
    ResultTable table("", stability_columns(), stability_key_columns);
    run_stability_study(study, table, ignore);
    ASSERT_EQ(table.rows().size(), 2 * stability_points(study.axes, true).size());
    std::set<std::string> laws;
    for (const Row& row : table.rows()) {
        const std::string text = joined(row, " ");
        ASSERT_EQ(row.size(), stability_columns().size()) << text;
        EXPECT_TRUE(row[8] == "ok" || row[8] == "unstable") << text;
        for (const std::size_t column : {9u, 10u, 11u}) EXPECT_EQ(row[8] == "ok", row[column].empty()) << text;
        for (std::size_t column = 12; column < row.size(); ++column) EXPECT_FALSE(row[column].empty()) << text;
        if (row[8] == "ok") {
            EXPECT_LE(std::stod(row.back()), 1) << text;
        } else if (row[9] != "finite") {
            EXPECT_GT(std::stod(row.back()), 1) << text;
        }
        if (row[4] == "dt" && row[5] == "1") {
            EXPECT_EQ(row[8], "ok") << text;
        }
        laws.insert(row[9]);
    }
    EXPECT_TRUE(laws.contains("tank")) << "scheme flex loses its water at 32 times the time step";
}

StabilityCase case_of(const char* scene, const char* axis, double value) {
    StabilityCase subject = calm_case(stability_scene(scene));
    subject.scene.scheme = Scheme::conserving;
    subject.scene.duration = 0.2;
    stability_axis(axis).set(subject, value);
    return subject;
}

/// The same tests: what a study calls broken, an evaluation does, at the same particle and time, and what it calls ok
/// as well.
TEST(StabilityTest, IsJudgedAsEvaluationsAre) {
    for (const Scheme scheme : {Scheme::flex, Scheme::conserving})
        for (const auto& [axis, value] : std::vector<std::pair<const char*, double>>{{"dt", 1},
                                                                                     {"dt", 32},
                                                                                     {"gravity", 100},
                                                                                     {"mass-ratio", 1e-4},
                                                                                     {"overlap", 0.5},
                                                                                     {"viscosity", 1e4},
                                                                                     {"radius-ratio", 1.01}}) {
            StabilityCase subject = case_of("small-tank", axis, value);
            subject.scene.scheme = scheme;
            subject.scene.stopping = {.plane_contact = false, .no_progress_after = 0};
            subject.scene.duration = std::max(8 * subject.scene.time_step, 0.2);
            const auto expected = evaluate(subject.scene, subject.gait).instability;
            const auto found = run_stability(subject, Precision::single_precision).instability;
            ASSERT_EQ(found.has_value(), expected.has_value()) << axis << ' ' << value;
            if (!found) continue;
            EXPECT_EQ(found->law, expected->law) << axis << ' ' << value;
            EXPECT_EQ(found->particle, expected->particle) << axis << ' ' << value;
            EXPECT_EQ(found->time, expected->time) << axis << ' ' << value;
        }
}

/// A start behind a wall breaks a law by itself; it is judged by what the run makes of it.
TEST(StabilityTest, AStartThatBreaksALawIsJudgedLater) {
    StabilityCase subject = case_of("small-tank", "outside", 1);
    subject.scene.duration = 1;
    EXPECT_GT(subject.judged_from, 0);
    EXPECT_FALSE(run_stability(subject, Precision::single_precision).instability);
    subject.judged_from = 0;
    EXPECT_EQ(run_stability(subject, Precision::single_precision).instability.value().law, "tank");
}

TEST(StabilityTest, ScenesAreCalm) {
    for (const StabilityScene& scene : stability_scenes()) {
        if (scene.name == "large-tank") continue;  // takes minutes: results/stability/gpu.csv
        for (const Scheme scheme : {Scheme::flex, Scheme::conserving}) {
            if (scheme == Scheme::flex && scene.conserving_only) continue;
            StabilityCase subject = case_of(scene.name.c_str(), "dt", 1);
            subject.scene.scheme = scheme;
            const StabilityResult result = run_stability(subject, Precision::single_precision);
            EXPECT_FALSE(result.instability) << scene.name << ": " << result.instability->law;
            EXPECT_GT(result.margins.largest(), 0) << scene.name;
        }
    }
    EXPECT_THROW(stability_scene("bathtub"), InputError);
    EXPECT_THROW(case_of("periodic-tank", "outside", 1), InputError) << "it has no wall there";
}

TEST(StabilityTest, WhatASceneCannotDoIsLeftOutAndSaid) {
    ResultTable table("", stability_columns(), stability_key_columns);
    std::string said;
    run_stability_study({.schemes = {Scheme::flex, Scheme::conserving},
                         .precisions = {Precision::single_precision},
                         .axes = {"outside"},
                         .quick = true,
                         .scenes = {"periodic-tank"}},
                        table, [&](const std::string& line) { said += line; });
    EXPECT_TRUE(table.rows().empty());
    EXPECT_EQ(
        said,
        "left out: conserving float cpu periodic-tank outside 1  : axis outside: needs a wall at the tank's right end");
}

TEST(StabilityTest, PointsAreNamedByAxisOrMap) {
    const auto map = stability_points({"dt:stiffness"}, false);
    EXPECT_EQ(map.size(), 48u);
    EXPECT_EQ(map.front().second_axis, "stiffness");
    EXPECT_GT(stability_points({}, false).size(), 300u);
    EXPECT_THROW(stability_points({"luck"}, true), InputError);
}

TEST(StabilityTest, TellsWhereOnlyFlexIsOk) {
    const auto row = [](const char* scheme, const char* value, const char* status, const char* law) {
        return Row{scheme, "float", "cpu", "far", "dt", value, "", "", status, law, "", "", "", "", "", "", "", "", ""};
    };
    const std::vector<Row> rows{row("flex", "1", "ok", ""),
                                row("flex", "2", "ok", ""),
                                row("flex", "4", "unstable", "tank"),
                                row("conserving", "1", "ok", ""),
                                row("conserving", "2", "unstable", "energy"),
                                row("conserving", "4", "ok", "")};
    EXPECT_EQ(where_only_flex_is_ok(rows), (std::vector<std::string>{"float cpu far dt 2: energy"}));
}

/// The starts and settings that scheme conserving bore worst.
TEST(StabilityTest, ConservingBearsWhatFlexBears) {
    const std::vector<std::pair<std::string, double>> hard = {
        {"overlap", 0.9},         {"overlap", 0.5},       {"body-clearance", 0}, {"outside", 1},    {"mass-ratio", 100},
        {"radius-ratio", 1.0001}, {"radius-ratio", 1.01}, {"radius-ratio", 3},   {"iterations", 64}};
    for (const auto& [axis, value] : hard) {
        StabilityCase subject = calm_case();
        subject.scene.scheme = Scheme::conserving;
        stability_axis(axis).set(subject, value);
        const StabilityResult result = run_stability(subject, Precision::single_precision);
        EXPECT_FALSE(result.instability) << axis << ' ' << value << ": " << result.instability->law;
    }
}

/// Velocities at the edge of the numbers: the run ends as unstable, and at once.
TEST(StabilityTest, PositionsBeyondTheNumbersEndTheRun) {
    for (const Scheme scheme : {Scheme::flex, Scheme::conserving}) {
        Subject subject = make_subject("falling-drop");
        subject.model.scheme = scheme;
        Solver<double> solver(subject.model);
        State<double> state = initial_state<double>(subject.model);
        state.velocity[0].x() = std::numeric_limits<double>::max();
        state.velocity[1].x() = std::numeric_limits<double>::lowest();
        subject.model.parameters.max_speed = std::numeric_limits<double>::max();
        const auto instability = solver.update(state, 4, 1);
        ASSERT_TRUE(instability);
        EXPECT_EQ(instability->particle, 0);
        EXPECT_EQ(instability->stage, "predict");
    }
}

/// Z = 1 + T, and the same 0.25 later.
TEST(FrontErrorTest, AGateThatOpensLateIsALag) {
    const FrontCurve computed{{0, 1}, {1, 2}, {4, 5}};
    FrontCurve measured;
    for (const double time : {0.75, 1.25, 2.25}) measured.push_back({time, 1 + time - 0.25});
    const FrontError error = front_error(computed, measured);
    EXPECT_NEAR(error.position, 0.25, 1e-12);
    EXPECT_NEAR(error.lag, 0.25, 1e-12);
    EXPECT_NEAR(error.position_after_lag, 0, 1e-12);
    EXPECT_NEAR(error.arrival, (0.25 / 0.75 + 0.25 / 1.25 + 0.25 / 2.25) / 3, 1e-12);
    measured.push_back({4.5, 9});  // further than the computed front came
    EXPECT_EQ(front_error(computed, measured).position, error.position);
}

TEST(FrontErrorTest, CurvesAreLinearBetweenTheirPoints) {
    const FrontCurve curve{{0, 1}, {2, 2}, {3, 4}};
    EXPECT_NEAR(position_at(curve, 1), 1.5, 1e-15);
    EXPECT_NEAR(time_at(curve, 3), 2.5, 1e-15);
    EXPECT_EQ(position_at(curve, 9), 4);
}

TEST(ReferencesTest, FrontsGoForwardAndPeersHaveFigures) {
    for (const int height : {1, 2}) {
        const FrontCurve front = measured_front(height);
        ASSERT_GE(front.size(), 15u);
        for (std::size_t i = 1; i < front.size(); ++i) {
            EXPECT_GT(front[i].time, front[i - 1].time);
            EXPECT_GT(front[i].position, front[i - 1].position);
            EXPECT_LT(front[i].position, 1 + 2 * front[i].time);  // Ritter (1892): no front is faster than 2 sqrt(g h)
        }
    }
    EXPECT_THROW(measured_front(3), InputError);
    for (const PeerRun& peer : peer_runs()) {
        EXPECT_GT(peer.run_time, 0) << peer.name;
        EXPECT_GT(peer.density_error_max, peer.density_error_mean) << peer.name;
    }
}

TEST(DamBreakTest, TheColumnFillsItsPlaceBehindTheGate) {
    const Model model = dam_break_model({.height_over_base = 2, .width = 6, .ideal = true}, Scheme::flex);
    EXPECT_EQ(model.particles(), 6 * 12 * 10);
    for (const Eigen::Vector3d& x : model.position)
        for (const Plane& plane : model.planes)
            EXPECT_GE(plane.distance(x), model.parameters.collision_distance - 1e-12);
    EXPECT_EQ(model.parameters.flex.viscosity, 0);
}

TEST(ValidationTest, QuickStudyGivesPlausibleRowsAndGoesOn) {
    const TemporaryPath file("-validation.csv"), path("-validation-fronts.csv");
    ValidationStudy study;
    study.dam_breaks = {"tall"};
    study.width = 8;
    study.last_time = 2;
    study.dam_break_settings = {{Scheme::conserving, Precision::single_precision, 4, 4}};
    study.tank_settings = {{Scheme::flex, Precision::single_precision, 2, 1},
                           {Scheme::conserving, Precision::single_precision, 2, 1}};
    study.rest = study.window = 0.05;
    ResultTable table(file.path, validation_columns(), validation_key_columns);
    ResultTable fronts(path.path, front_columns(), front_key_columns);
    run_validation_study(study, table, fronts, ignore);
    ASSERT_EQ(table.rows().size(), 3 + peer_runs().size());
    const Row& column = table.rows().front();
    EXPECT_EQ(column[7], "ok");
    EXPECT_NEAR(std::stod(column[11]), 2, 0.1);  // start_height
    EXPECT_LT(std::stod(column[12]), 0.3);       // front_error
    for (const Row& row : table.rows()) {
        ASSERT_EQ(row.size(), validation_columns().size());
        if (row[0] == "tank") {
            EXPECT_LT(std::stod(row[16]), std::stod(row[17])) << joined(row, " ");
        }
    }
    FrontCurve front;
    for (const Row& row : fronts.rows())
        if (row[2] == "conserving") front.push_back({std::stod(row[6]), std::stod(row[7])});
    ASSERT_GT(front.size(), 10u);
    // Exact: 1. Water is disordered by up to a fifth of the particles' distance, 1/8: the foremost is less than 0.025
    // ahead.
    EXPECT_NEAR(front.front().position, 1, 0.02);
    EXPECT_GT(front.back().position, 1.8);

    const std::string before = content(file.path), path_before = content(path.path);
    ResultTable again(file.path, validation_columns(), validation_key_columns);
    ResultTable fronts_again(path.path, front_columns(), front_key_columns);
    run_validation_study(study, again, fronts_again, ignore);
    EXPECT_EQ(content(file.path), before);
    EXPECT_EQ(content(path.path), path_before);
    study.dam_breaks = {"burst"};
    EXPECT_THROW(run_validation_study(study, again, fronts_again, ignore), InputError);
}

}  // namespace
}  // namespace natator::bench
