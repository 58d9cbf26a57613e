// Parameters that the thesis leaves at 0, on single particles and solids: what each does, in both schemes.
#include <nlohmann/json.hpp>

#include "bare_particles.h"
#include "energy.h"
#include "natator/evaluate.h"
#include "natator/solver.h"
#include "scene/scene_json.h"

namespace natator {
namespace {

using namespace test;

class Parameters : public EffectTest {};

/// Without gravity a particle leaves a plane at restitution times its impact speed, exactly.
TEST_P(Parameters, RestitutionIsTheRatioOfSpeedsAtAPlane) {
    for (const double e : {0.0, 0.5, 0.9, 1.0}) {
        Model model = bare_model(GetParam(), {{0, 0.1, 0}}, solid_phase);
        model.planes = {{{0, 1, 0}, 0}};
        model.velocity[0] = {0.7, -3, 0};
        model.parameters.restitution = e;
        in_both_precisions([&]<class Real>(Real) {
            const auto state = run<Real>(model, 10);
            EXPECT_NEAR(state.velocity[0].y(), 3 * e, 1e-5);
            EXPECT_NEAR(state.velocity[0].x(), 0.7, 1e-5);
        });
    }
}

/// Dropped from 2 above where it rests it rises to e^2 of that, and comes to rest in the end.
TEST_P(Parameters, RestitutionSquaredIsTheRatioOfHeights) {
    Model model = bare_model(GetParam(), {{0, 2.05, 0}}, solid_phase);
    model.planes = {{{0, 1, 0}, 0}};
    model.parameters.gravity = {0, -10, 0};
    model.parameters.restitution = 0.5;
    Solver<double> solver(model);
    State<double> state = initial_state<double>(model);
    advance(solver, state, static_cast<int>(std::sqrt(2 * 2 / 10.0) / substep) + 3);
    EXPECT_GT(state.velocity[0].y(), 0);
    double highest = 0;
    for (int k = 0; k < 120; ++k) {
        advance(solver, state, 1);
        highest = std::max(highest, state.position[0].y() - 0.05);
    }
    EXPECT_NEAR(highest / 2, 0.25, 0.01);
    advance(solver, state, 1200);
    EXPECT_NEAR(state.position[0].y(), 0.05, 1e-6);
    EXPECT_NEAR(state.velocity[0].norm(), 0, 1e-6);
}

/// On the ceiling against gravity 10: held with more adhesion than that, let go with less.
TEST_P(Parameters, AdhesionWithstandsAPullUpToItsSize) {
    for (const double adhesion : {0.0, 9.9, 10.1}) {
        Model model = bare_model(GetParam(), {{0, 0.95, 0}}, solid_phase);
        model.planes = {{{0, -1, 0}, 1}};
        model.parameters.gravity = {0, -10, 0};
        model.parameters.adhesion = adhesion;
        in_both_precisions([&]<class Real>(Real) {
            const auto state = run<Real>(model, 240);
            if (adhesion > 10)
                EXPECT_NEAR(state.position[0].y(), 0.95, 1e-5);
            else
                EXPECT_LT(state.position[0].y(), -1);
        });
    }
}

/// A force that gives less than the threshold within a substep moves nothing; a larger one moves as without it.
TEST_P(Parameters, SleepingParticlesStayWhereTheyAre) {
    Model model = bare_model(GetParam(), {{0, 1, 0}}, solid_phase);
    model.parameters.sleep_threshold = 0.01;
    in_both_precisions([&]<class Real>(Real) {
        model.parameters.gravity = {0, -0.009 / substep, 0};
        const auto held = run<Real>(model, 100);
        EXPECT_EQ(held.position[0], initial_state<Real>(model).position[0]);
        EXPECT_EQ(held.velocity[0].norm(), 0);
        model.parameters.gravity = {0, -0.011 / substep, 0};
        const auto falling = run<Real>(model, 100);
        EXPECT_NEAR(falling.velocity[0].y(), -1.1, 1e-4);
    });
}

/// A stack of ten solids under gravity sinks together less with shock propagation.
TEST_P(Parameters, ShockPropagationKeepsAStackUp) {
    const auto height = [](double k, auto real) {
        Model model = bare_model(GetParam(), lattice(1, 10, 1, 0.15, {0, 0.725, 0}), solid_phase);
        model.planes = {{{0, 1, 0}, 0}};
        model.parameters.gravity = {0, -10, 0};
        model.parameters.shock_propagation = k;
        const auto state = run<decltype(real)>(model, 240);
        double top = 0;
        for (const auto& x : state.position) top = std::max(top, static_cast<double>(x.y()));
        return top;
    };
    in_both_precisions([&]<class Real>(Real real) {
        const double full = 0.05 + 9 * 0.15;
        EXPECT_LT(full - height(20, real), 0.7 * (full - height(0, real)));
        EXPECT_GT(full - height(0, real), 0.001);
    });
}

/// A cluster of overlapping solids parts more slowly; a pair and a triangle are damped as documented, exactly.
TEST_P(Parameters, DissipationDampsInContacts) {
    const auto parted = [](double dissipation, const Points& points, auto real) {
        Model model = bare_model(GetParam(), points, solid_phase);
        for (int i = 0; i < model.particles(); ++i) model.inverse_mass[i] = 1 + i % 3;
        model.parameters.dissipation = dissipation;
        const auto state = run<decltype(real)>(model, 1);
        if (GetParam() == Scheme::conserving) {
            EXPECT_LT(momentum(model, state).norm(), 1e-6 * momentum_size(model, state));
        }
        return kinetic_energy(model, state);
    };
    in_both_precisions([&]<class Real>(Real real) {
        const Points cube = lattice(3, 3, 3, 0.13);
        EXPECT_LT(parted(200, cube, real), 0.8 * parted(0, cube, real));

        const double step = 24 * substep;
        const auto factor = [&](const Points& points) {
            Model model = bare_model(GetParam(), points, solid_phase);
            const double speed = run<Real>(model, 1).velocity[1].norm();
            model.parameters.dissipation = 24;
            return run<Real>(model, 1).velocity[1].norm() / speed;
        };
        const bool flex = GetParam() == Scheme::flex;
        const double side = 0.13;
        EXPECT_NEAR(factor({{0, 0, 0}, {side, 0, 0}}), flex ? 1 : 1 / (1 + 2 * step), 1e-5);
        const Points triangle = {{0, 0, 0}, {side, 0, 0}, {side / 2, side * std::sqrt(0.75), 0}};
        EXPECT_NEAR(factor(triangle), flex ? 1 / (1 + step) : 1 - 3 * step / (1 + 4 * step), 1e-5);
    });
}

/// No particle is ever faster, whatever pushes it.
TEST_P(Parameters, MaxSpeedHoldsForEveryForce) {
    Model model = bare_model(GetParam(), lattice(4, 4, 4, 0.07, {0, 0.3, 0}), fluid_phase);
    model.planes = {{{0, 1, 0}, 0}};
    model.parameters.gravity = {0, -10, 0};
    model.parameters.max_speed = 0.5;
    model.parameters.restitution = 1;
    model.parameters.cohesion = 0.01;
    model.parameters.surface_tension = 20;
    model.parameters.vorticity_confinement = 1;
    in_both_precisions([&]<class Real>(Real) {
        Solver<Real> solver(model);
        State<Real> state = initial_state<Real>(model);
        double fastest = 0;
        for (int k = 0; k < 60; ++k) {
            advance(solver, state, 1);
            for (const auto& v : state.velocity) fastest = std::max(fastest, static_cast<double>(v.norm()));
        }
        EXPECT_LE(fastest, 0.5 + 1e-5);
        EXPECT_GT(fastest, 0.4);
    });
}

/// At 0 no stage runs: the plan has none of them, and is the longer by one line each when they are on.
TEST_P(Parameters, NothingIsPlannedAtZero) {
    Model model = bare_model(GetParam(), lattice(2, 2, 2, 0.1), fluid_phase);
    model.phase[0] = solid_phase;
    model.planes = {{{0, 1, 0}, 1}};
    model.parameters.gravity = {0, -10, 0};
    const std::size_t lines = describe_plan(model).size();
    SolverParameters& p = model.parameters;
    for (double* parameter : {&p.restitution, &p.adhesion, &p.sleep_threshold, &p.dissipation, &p.cohesion,
                              &p.surface_tension, &p.vorticity_confinement, &p.free_surface_drag}) {
        *parameter = 0.5;
        EXPECT_EQ(describe_plan(model).size(), lines + 1);
        *parameter = 0;
    }
    EXPECT_FALSE(make_plan(model).shock_propagation);
    p.shock_propagation = 1;
    EXPECT_TRUE(make_plan(model).shock_propagation);
}

/// Two springs pull a particle by 0.5 and by 0.3: factor 0 moves it by their mean in Flex' local mode, and not at all
/// where the factor multiplies, in global mode and in scheme conserving.
TEST_P(Parameters, RelaxationFactorZeroIsTheMeanOrNothing) {
    for (const RelaxationMode mode : {RelaxationMode::local, RelaxationMode::global}) {
        Model model = bare_model(GetParam(), {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, solid_phase);
        model.inverse_mass = {1, 0, 0};
        model.springs = {{0, 1, 0.5, 1}, {0, 2, 1.7, 1}};
        model.parameters.iterations = 1;
        model.parameters.flex.relaxationMode = mode;
        model.parameters.relaxation_factor = 0;
        const bool mean = GetParam() == Scheme::flex && mode == RelaxationMode::local;
        in_both_precisions([&]<class Real>(Real) {
            const auto state = run<Real>(model, 1);
            EXPECT_NEAR(state.position[0].x(), mean ? 0.4 : 0, 1e-6);
            EXPECT_NEAR(state.position[0].y(), 0, 1e-6);
        });
    }
}

/// A whole scene with it stays finite, with every kind of constraint there is.
TEST_P(Parameters, RelaxationFactorZeroIsAllowedInAScene) {
    for (const char* mode : {"local", "global"}) {
        Scene scene = load_scene(
            "bench/small-tank",
            nlohmann::json{{"duration", 0.05}, {"solver", {{"relaxationFactor", 0}, {"relaxationMode", mode}}}});
        scene.scheme = GetParam();
        const Evaluation result = evaluate(scene, {1, {1, 1}, {0, 0.5}, 1});
        EXPECT_FALSE(result.instability) << mode;
        EXPECT_TRUE(std::isfinite(result.distance) && std::isfinite(result.errors.density_error_mean)) << mode;
    }
}

INSTANTIATE_TEST_SUITE_P(Schemes, Parameters, testing::Values(Scheme::flex, Scheme::conserving), scheme_name);

}  // namespace
}  // namespace natator
