// Periodic tanks: what leaves at one end comes in at the other, and nothing can tell where the ends are.
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>

#include "bare_particles.h"
#include "model/fit_to_water.h"
#include "natator/evaluate.h"
#include "natator/measure.h"
#include "natator/simulation.h"
#include "periodic_models.h"
#include "protocol/stream.h"
#include "refusal.h"
#include "run/settled_state_key.h"

namespace natator {
namespace {

using namespace test;
using nlohmann::json;

template <class Real>
State<Real> after_frames(const Model& model, int frames, int threads = 1) {
    Execution execution;
    execution.threads = threads;
    Solver<Real> solver(model, execution);
    State<Real> state = initial_state<Real>(model);
    advance_frames(solver, model, state, frames);
    return state;
}

/// Whatever the tank's place and length, what one of a pair sees of the other through an end is bit for bit the
/// opposite of what that one sees: ghosts are nowhere rounded.
template <class Real>
void expect_exactly_opposite_pairs() {
    for (const PeriodicAxis& axis : {PeriodicAxis{0, 0, 2.4}, {0, -0.7, 1.1}, {0, 0.1, 4.51}, {0, 100.3, 103}}) {
        Model model = box_of_water({1, 1, 1});
        model.periodic = {axis};
        const auto seam = periodic_axes_of<Real>(model).front();
        EXPECT_NEAR(static_cast<double>(seam.low), axis.low, 1e-5);
        EXPECT_NEAR(static_cast<double>(seam.length), axis.length(), 1e-5);
        for (int k = 0; k < 1000; ++k) {
            const Real a = to_tank(seam, static_cast<Real>(axis.low + 0.000123 * k));
            const Real b = to_tank(seam, static_cast<Real>(axis.high - 0.000077 * (k % 97) - 5 * axis.length()));
            ASSERT_TRUE(in_tank(seam, a) && in_tank(seam, b));
            ASSERT_EQ(a - (b - seam.length), -(b - (a + seam.length))) << k;
            ASSERT_NEAR(static_cast<double>(a), axis.low + 0.000123 * k, 1e-5);
        }
    }
}

TEST(Periodic, PairsThroughTheEndsAreExactlyOpposite) {
    expect_exactly_opposite_pairs<float>();
    expect_exactly_opposite_pairs<double>();
}

/// Pairs across the seam are equal and opposite, as all are: with no wall across an axis the momentum along it stays.
template <class Real>
void expect_momentum_along_periodic_axes(const Model& model, double bound) {
    const State<Real> before = initial_state<Real>(model), after = after_frames<Real>(model, 20);
    ASSERT_EQ(model.periodic.size(), 2u);
    const Eigen::Vector3d change = momentum(model, after) - momentum(model, before);
    const double size = momentum_size(model, before);
    EXPECT_LE(std::abs(change.x()), bound * size);
    EXPECT_LE(std::abs(change.z()), bound * size);
    EXPECT_GT(std::abs(change.y()), 1e-3 * size);  // the floor pushes
}

TEST(Periodic, MomentumIsKeptThroughTheEnds) {
    Model model = stirred_periodic_water({0, 2});
    model.parameters.gravity.setZero();  // what holds water up at walls does not keep the momentum along them
    expect_momentum_along_periodic_axes<float>(model, 1e-6);
    expect_momentum_along_periodic_axes<double>(model, 1e-14);
    model.parameters.cohesion = 0.002;
    model.parameters.surface_tension = 20;
    expect_momentum_along_periodic_axes<double>(model, 1e-14);
}

/// With no wall at all it is kept whole.
TEST(Periodic, MomentumIsKeptInWaterWithoutWalls) {
    Model model = stirred_periodic_water({0, 2});
    model.planes.clear();
    model.parameters.gravity.setZero();
    const State<double> before = initial_state<double>(model), after = after_frames<double>(model, 20);
    EXPECT_LE((momentum(model, after) - momentum(model, before)).norm(), 1e-14 * momentum_size(model, before));
}

/// Where the ends are makes no difference: the same water, half a tank further on, does the same half a tank further
/// on.
TEST(Periodic, TheEndsCanNotBeTold) {
    for (const std::vector<int>& axes : {std::vector<int>{0}, {2}, {0, 2}}) {
        const Model model = stirred_periodic_water(axes);
        for (std::size_t k = 0; k < axes.size(); ++k) {
            const double half = model.periodic[k].length() / 2;
            const State<double> here = after_frames<double>(model, 6);
            const State<double> there = after_frames<double>(moved_on(model, k, half), 6);
            EXPECT_LE(max_difference(model, here, there, half * Eigen::Vector3d::Unit(axes[k])), 1e-10) << axes[k];
            EXPECT_GT(max_difference(model, initial_state<double>(model), here, {0, 0, 0}), 0.05);
        }
    }
}

/// A tank of water that flows as a whole is one at rest, seen from a frame that moves; and it stays within its ends.
TEST(Periodic, AUniformFlowIsWaterAtRest) {
    Model model = made_periodic(box_of_water({8, 6, 7}), {0, 2});
    const State<double> still = after_frames<double>(model, 30);
    const Eigen::Vector3d flow(2, 0, -1.5);
    for (auto& v : model.velocity) v = flow;
    const State<double> flowing = after_frames<double>(model, 30);
    EXPECT_LE(max_difference(model, still, flowing, 30 * model.time_step * flow), 1e-9);
    for (int i = 0; i < model.particles(); ++i) {
        EXPECT_LE((flowing.velocity[i] - still.velocity[i] - flow).norm(), 1e-9);
        for (const PeriodicAxis& axis :
             model.periodic) {  // wrapped at the start of a substep, so no further out than its way
            EXPECT_GE(flowing.position[i][axis.axis], axis.low - 0.05);
            EXPECT_LE(flowing.position[i][axis.axis], axis.high + 0.05);
        }
    }
}

/// v_z = U sin(k x) in water without ends along x and z is an exact solution of Navier and Stokes: it decays by
/// exp(-nu k^2 t), here to 0.82 in a second. Without viscosity it stays.
TEST(Periodic, AShearWaveDecaysByItsViscosity) {
    const int across = 20;
    const double length = across * water_spacing, k = 2 * std::numbers::pi / length, speed = 0.5, viscosity = 0.02;
    const int frames = 60;
    const auto amplitude_after = [&](double nu) {
        Model model = made_periodic(box_of_water({across, 8, 6}), {0, 2});
        model.planes.push_back({{0, -1, 0}, 8 * water_spacing});
        model.parameters.gravity.setZero();
        model.parameters.conserving.kinematic_viscosity = nu;
        for (int i = 0; i < model.particles(); ++i) model.velocity[i].z() = speed * std::sin(k * model.position[i].x());
        const State<float> state = after_frames<float>(model, frames);
        double sum = 0, squares = 0;
        for (int i = 0; i < model.particles(); ++i) {
            const double wave = std::sin(k * static_cast<double>(state.position[i].x()));
            sum += wave * static_cast<double>(state.velocity[i].z());
            squares += wave * wave;
        }
        return sum / squares;
    };
    const double time = frames / 60.0, viscous = amplitude_after(viscosity), inviscid = amplitude_after(0);
    const double measured = -std::log(viscous / speed) / (k * k * time);
    std::cout << "measured: viscosity " << measured << " of " << viscosity << ", without it " << inviscid / speed
              << " is left\n";
    EXPECT_NEAR(measured / viscosity, 1, 0.1);
    EXPECT_GT(inviscid, 0.98 * speed);
}

/// Every particle has the neighbours that the tank set out again and again would give it: through an end, two ends, and
/// an end and the floor; also those on the very seam, which are there but once.
TEST(Periodic, CornersAreFullOfNeighbours) {
    Model model = stirred_periodic_water({0, 2});
    Solver<double> solver(model);
    State<double> state = initial_state<double>(model);
    advance_frames(solver, model, state, 2);
    for (int i = 0; i < model.particles(); i += 7) state.position[i].x() = model.periodic[0].low;
    for (int i = 0; i < model.particles(); i += 11) state.position[i].z() = model.periodic[1].high;  // is the low end
    const State<double> start = state;
    ASSERT_FALSE(solver.update(state, 1e-9, 1));
    const std::vector<int> counts = solver.neighbour_counts();
    const double reach = support(model);
    int beyond = 0;
    for (int i = 0; i < model.particles(); ++i) {
        int expected = 0;
        for (int j = 0; j < model.particles(); ++j)
            for (int copy = 0; copy < 18; ++copy) {
                Eigen::Vector3d x = start.position[j];
                x.x() += (copy % 3 - 1) * model.periodic[0].length();
                x.z() += (copy / 3 % 3 - 1) * model.periodic[1].length();
                if (copy >= 9) x.y() = -x.y();  // the floor's
                if ((i == j && copy == 4) || (x - start.position[i]).norm() >= reach) continue;
                ++expected;
                beyond += copy != 4;
            }
        ASSERT_EQ(counts[i], expected) << start.position[i].transpose();
    }
    EXPECT_GT(beyond, 1000);
}

/// A body crosses the seam as it crosses any other place, and goes on where it is: whole laps away it is the same body.
TEST(Periodic, ABodyGoesRoundAndRound) {
    const Model middle = cube_through_periodic_water(0.55), seam = cube_through_periodic_water(0.95);
    const double length = middle.periodic[0].length();
    Model laps = seam;
    for (int i = 0; i < laps.particles(); ++i)
        if (!laps.is_fluid(i)) laps.position[i].x() -= 3 * length;
    Execution execution;
    execution.forces = true;
    Solver<double> in_the_middle(middle, execution), at_the_seam(seam, execution), laps_away(laps, execution);
    State<double> a = initial_state<double>(middle), b = initial_state<double>(seam), c = initial_state<double>(laps);
    const Eigen::Vector3d before = momentum(middle, a);
    for (int frame = 0; frame < 12; ++frame) {
        advance_frames(in_the_middle, middle, a, 1);
        advance_frames(at_the_seam, seam, b, 1);
        advance_frames(laps_away, laps, c, 1);
    }
    EXPECT_LE(max_difference(middle, a, b, {0.4, 0, 0}), 1e-10);
    EXPECT_LE(max_difference(middle, a, c, {0.4, 0, 0}), 1e-10);
    double largest = 0;
    const auto forces = in_the_middle.forces(), others = at_the_seam.forces();
    for (const int i : middle.clusters.front().particles) {
        EXPECT_LE((b.position[i] - a.position[i] - Eigen::Vector3d(0.4, 0, 0)).norm(), 1e-10);  // not wrapped
        EXPECT_LE((c.position[i] - b.position[i] + Eigen::Vector3d(3 * length, 0, 0)).norm(), 1e-10);
        EXPECT_LE((forces[i] - others[i]).norm(), 1e-6);
        largest = std::max(largest, forces[i].norm());
    }
    EXPECT_GT(largest, 0.1);
    EXPECT_LE((momentum(seam, b) - before).cwiseProduct(Eigen::Vector3d(1, 0, 1)).norm(),
              1e-13 * momentum_size(seam, b));
}

TEST(Periodic, WhatABodyFeelsIsTheSameAtTheSeam) {
    const auto felt = [](double x) {
        Model model = cube_through_periodic_water(x);
        Body& body = model.body;
        body.particles = model.clusters.front().particles;
        for (auto slice = body.particles.begin(); slice != body.particles.end(); slice += 9)
            body.slices.emplace_back(slice, slice + 9);
        body.length = 0.3;
        const State<double> state = after_frames<double>(model, 6);
        const Sensing sensing{.flow = {{0, SkinPlace::Side::left}, {2, SkinPlace::Side::above}}, .within = 0.3};
        return sense(model, state, sensing).flow;
    };
    const auto middle = felt(0.55), seam = felt(0.95);
    for (int k = 0; k < 2; ++k) {
        EXPECT_GT(middle[k].particles, 5);
        EXPECT_EQ(middle[k].particles, seam[k].particles);
        EXPECT_LE((middle[k].velocity - seam[k].velocity).norm(), 1e-9);
        EXPECT_GT(middle[k].velocity.norm(), 0.1);
    }
}

TEST(Periodic, AnyNumberOfThreadsGivesTheSameBits) {
    const Model model = cube_through_periodic_water(0.95);
    const State<float> one = after_frames<float>(model, 5), three = after_frames<float>(model, 5, 3);
    EXPECT_TRUE(std::equal(one.position.begin(), one.position.end(), three.position.begin()));
    EXPECT_TRUE(std::equal(one.velocity.begin(), one.velocity.end(), three.velocity.begin()));
}

/// Of gravity along a periodic axis nothing lies on a wall: the water falls freely, and its depth asks for no substeps.
TEST(Periodic, WaterFallsFreelyAlongAPeriodicAxis) {
    Model model = made_periodic(box_of_water({8, 6, 7}), {0, 2});
    model.parameters.gravity.setZero();
    const State<double> weightless = after_frames<double>(model, 10);
    model.parameters.gravity = {3, 0, 0};
    const State<double> falling = after_frames<double>(model, 10);
    for (int i = 0; i < model.particles(); ++i)
        EXPECT_LE((falling.velocity[i] - weightless.velocity[i] - Eigen::Vector3d(0.5, 0, 0)).norm(), 1e-9);
    model.time_step = 0.0665;
    const auto substeps = [&](const Eigen::Vector3d& gravity) {
        Model fitted = model;
        fitted.parameters.gravity = gravity;
        fit_to_water(fitted);
        return fitted.parameters.substeps;
    };
    EXPECT_EQ(substeps({9, 0, 0}), 2);  // a fall of 0.01 from rest in each
    EXPECT_EQ(substeps({0, -9, 0}), 3);
}

/// Creature 1 in a short tank, soon to swim through its end.
json in_round_tank(const json& overrides = json::object()) {
    json all = json::parse(R"({"periodic": ["x"], "duration": 1, "settling": {"updates": 10},
        "planes": [[0,1,0,0],[1,0,0,0],[-1,0,0,2],[0,0,1,0],[0,0,-1,1]], "fluid": {"count": [20, 8, 10]},
        "creature": {"rearCentre": [0.75, 0.4, 0.5]}, "stopping": {"noProgressAfter": 0}})");
    all.merge_patch(overrides);
    return all;
}
Scene round_tank(const json& overrides = json::object()) {
    return load_scene("pool/creature-1", in_round_tank(overrides));
}

const Gait round_beat{2, {0.8, 1}, {0, 0.75}, 1};

TEST(Periodic, DistanceIsCountedAlongTheWay) {
    const Scene scene = round_tank();
    double first = 0, last = 0, max_step = 0, most = 0;
    bool begun = false;
    EvaluationOptions options;
    options.on_frame = [&](double, const std::vector<Eigen::Vector3d>& places) {
        double mean = 0;
        for (const Eigen::Vector3d& x : places) {
            mean += x.x() / static_cast<double>(places.size());
            most = std::max(most, x.x());
        }
        if (begun) max_step = std::max(max_step, std::abs(mean - last));
        if (!begun) first = mean;
        begun = true;
        last = mean;
    };
    const Evaluation swim = evaluate(scene, round_beat, options);
    EXPECT_EQ(swim.stopped, StopReason::completed);
    EXPECT_NEAR(swim.distance, last - first, 1e-9);
    EXPECT_GT(swim.distance, 0.02);
    EXPECT_GT(most, 2);  // beyond the end
    EXPECT_LT(max_step, 0.05);
}

TEST(Periodic, AStreamIsWhatAnEvaluationIs) {
    const json overrides = in_round_tank({{"duration", 0.25}});
    const Evaluation whole = evaluate(load_scene("pool/creature-1", overrides), round_beat);
    Simulation<float> live({"pool/creature-1", overrides.dump(), round_beat});
    while (live.frames() < whole.frames) ASSERT_TRUE(live.step());
    EXPECT_EQ(hash_text(state_hash(live.state())), hash_text(whole.hash));
    EXPECT_NEAR(live.distance(), whole.distance, 1e-9);
}

/// A frame tells the water around the swimmer, wherever that is: the same places but for whole lengths of the tank.
TEST(Periodic, AStreamTellsTheWaterAroundTheSwimmer) {
    Simulation<float> live({"pool/creature-1", in_round_tank().dump(), round_beat});
    for (int k = 0; k < 6; ++k) ASSERT_TRUE(live.step());
    const Model& model = live.model();
    const std::string message = stream_frame(live, {});
    const std::size_t first = 8 + 72 + 4 * static_cast<std::size_t>(model.actuators);
    ASSERT_EQ(message.size(), first + 12 * static_cast<std::size_t>(model.particles()));
    const double centre = mean_x(model.body, live.state());
    int moved = 0;
    for (int i = 0; i < model.particles(); ++i) {
        float told = 0;
        std::memcpy(&told, &message[first + 12 * static_cast<std::size_t>(i)], sizeof told);
        const double x = static_cast<double>(live.state().position[i].x()),
                     lengths = (static_cast<double>(told) - x) / 2;
        if (!model.is_fluid(i)) {
            ASSERT_EQ(told, live.state().position[i].x());
            continue;
        }
        ASSERT_LE(std::abs(static_cast<double>(told) - centre), 1 + 1e-6);
        ASSERT_NEAR(lengths, std::round(lengths), 1e-6);
        moved += std::abs(lengths) > 0.5;
    }
    EXPECT_GT(moved, 100);  // the swimmer's middle is not the tank's
    const auto head = stream_scene(live, {});
    EXPECT_EQ(json(head.at("periodic")), json::parse(R"({"x": [0, 2]})"));
    EXPECT_EQ(head.at("planes").size(), 3u);
}

/// Where the ends are is part of the key of a settled start.
TEST(Periodic, TheEndsBelongToASettledStart) {
    const json planes = {{0, 1, 0, 0}, {1, 0, 0, 0}, {-1, 0, 0, 2.05}, {0, 0, 1, 0}, {0, 0, -1, 1}};
    const Model model = build_model(round_tank()), longer = build_model(round_tank({{"planes", planes}}));
    ASSERT_EQ(model.position, longer.position);
    EXPECT_FALSE(settled_state_key(model, {}, 4) == settled_state_key(longer, {}, 4));
    EXPECT_TRUE(settled_state_key(model, {}, 4) == settled_state_key(build_model(round_tank()), {}, 4));
}

/// Water is cleared from around a body through the ends, too.
TEST(Periodic, WaterIsClearedThroughTheEnds) {
    const Model middle = build_model(round_tank({{"creature", {{"rearCentre", {0.4, 0.4, 0.5}}}}}));
    const Model end = build_model(round_tank({{"creature", {{"rearCentre", {0.8, 0.4, 0.5}}}}}));
    EXPECT_EQ(middle.particles(), end.particles());
}

TEST(Periodic, WithoutWaterNothingIsLeftToBePeriodic) {
    json overrides = in_round_tank({{"planes", json::array()}, {"solver", {{"gravity", {0, 0, 0}}}}});
    overrides["fluid"] = nullptr;
    const Scene scene = load_scene("pool/creature-1", overrides);
    EXPECT_TRUE(scene.periodic.empty());
    EXPECT_LE(std::abs(evaluate(scene, round_beat).distance), 1e-5);
}

class BadPeriodic : public testing::TestWithParam<BadInput> {};

TEST_P(BadPeriodic, IsRefused) {
    expect_refused("pool/creature-1", json::parse(GetParam().overrides), GetParam().field, {GetParam().allowed});
}

INSTANTIATE_TEST_SUITE_P(
    All, BadPeriodic,
    testing::ValuesIn(std::vector<BadInput>{
        {R"({"periodic":"x"})", "periodic = \"x\"", "an array of axes, \"x\" or \"z\""},
        {R"({"periodic":["y"]})", "periodic[0] = \"y\"", "must be \"x\" or \"z\""},
        {R"({"periodic":["x","q"]})", "periodic[1] = \"q\"", "must be \"x\" or \"z\""},
        {R"({"periodic":["x","x"]})", "periodic[1] = \"x\"", "named once"},
        {R"({"periodic":["x"],"scheme":"flex","solver":{"kinematicViscosity":0}})", "periodic: scheme = \"flex\"",
         "must be \"conserving\""},
        {R"({"periodic":["x"],"planes":[[0,1,0,0],[1,0,0,0]]})", "periodic[0] = \"x\"",
         "found 1 at the low end and 0 at the high end"},
        {R"({"periodic":["x"],"planes":[[0,1,0,0],[1,0,0,-3],[-1,0,0,2.6]]})", "periodic[0] = \"x\"",
         "low end is below its high end"},
        {R"({"periodic":["z"]})", "the body is 1.2 long, and the tank along z 1", "must be at least 1.7"},
        {R"({"periodic":["z"],"creature":null,"planes":[[0,0,1,0],[0,0,-1,0.45]],"fluid":{"count":[9,9,4]}})",
         "the tank is 0.45 long along z", "must be at least 0.5 (two kernel radii"},
        {R"({"periodic":["x"],"fluid":{"origin":[-0.1,0.05,0.05]}})", "periodic: particle at (-0.1, ",
         "must begin within [0, 2.6] along x"},
        {R"({"periodic":["x"],"obstacles":[{"shape":"sphere","centre":[2.2,0.5,0.5],"radius":0.1}]})",
         "periodic: has no room for a creature beside obstacles", "contacts"},
        {R"({"periodic":["x"],"creature":null,"obstacles":[{"shape":"box","centre":[1.3,0.2,0.5],"size":[2.6,0.2,0.2],"spacing":0.1}]})",
         "periodic: obstacles have a particle at (2.6, 0.1, 0.4), at the high end along x",
         "a spacing shorter than the tank"},
    }),
    [](const auto& bad) { return std::to_string(bad.index); });

/// An obstacle that goes on through the ends: what is nearest to it is everywhere as near.
TEST(Periodic, AnObstacleMayGoAllAlong) {
    const json beam = json::parse(R"({"periodic":["x"],"creature":null,
        "obstacles":[{"shape":"box","centre":[1.25,0.2,0.5],"size":[2.5,0.2,0.2],"spacing":0.1}]})");
    EXPECT_NO_THROW(build_model(load_scene("pool/creature-1", beam)));
}

TEST(Periodic, AllOtherPlanesAreAlongTheAxis) {
    Scene scene = round_tank();
    scene.planes = {{{0, 1, 0}, 0}, {{0.6, 0, 0.8}, 0}};
    try {
        build_model(scene);
        ADD_FAILURE() << "accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("periodic: plane [0.6, 0, 0.8, 0] is not along x"), std::string::npos)
            << error.what();
    }
}

/// Along an axis without ends a moving tank stays, and its current is another place of the ground.
TEST(Periodic, AMovingTankMovesAlongAxesThatHaveEnds) {
    const auto swim = [](const json& moving) {
        json overrides = in_round_tank({{"duration", 0.25}});
        if (!moving.is_null()) overrides["movingTank"] = moving;
        return evaluate(load_scene("pool/creature-1", overrides), round_beat);
    };
    const Evaluation still = swim(nullptr), flowing = swim({{"step", 0.001}, {"current", {-0.4, 0, 0.2}}});
    EXPECT_EQ(still.hash, flowing.hash);
    EXPECT_EQ(flowing.renewal->times, 0);
    EXPECT_NEAR(flowing.distance, still.distance - 0.4 * 0.25, 1e-12);
    EXPECT_GT(swim({{"step", 0.001}}).distance, 0.001);

    json overrides = {{"periodic", {"z"}},
                      {"movingTank", {{"along", "xz"}, {"step", 0.0005}}},
                      {"fluid", {{"count", {40, 8, 18}}}},
                      {"planes", {{0, 1, 0, 0}, {1, 0, 0, 0}, {-1, 0, 0, 4}, {0, 0, 1, 0}, {0, 0, -1, 1.8}}},
                      {"creature", {{"rearCentre", {1.4, 0.4, 0.9}}}},
                      {"duration", 0.25},
                      {"settling", {{"updates", 2}}}};
    EXPECT_GT(evaluate(load_scene("pool/creature-1", overrides), round_beat).renewal->times, 0);
}

}  // namespace
}  // namespace natator
