// Parameters of the fluid that the thesis leaves at 0: what each does, in all schemes.
#include "bare_particles.h"

namespace natator {
namespace {

using namespace test;

class FluidParameters : public EffectTest {};

/// Mean distance to the nearest neighbour.
template <class Real>
double mean_gap(const State<Real>& state) {
    double sum = 0;
    for (const auto& a : state.position) {
        double nearest = INFINITY;
        for (const auto& b : state.position)
            if (&a != &b) nearest = std::min(nearest, static_cast<double>((a - b).norm()));
        sum += nearest;
    }
    return sum / static_cast<double>(state.position.size());
}

/// Between two particles the force vanishes at fluid_rest_distance: pulled together from afar, apart from near.
TEST_P(FluidParameters, CohesionPullsBeyondTheRestDistanceAndPushesWithin) {
    for (const double r : {0.14, 0.12, 0.1, 0.08, 0.05}) {
        Model model = bare_model(GetParam(), {{0, 0, 0}, {r, 0, 0}}, fluid_phase);
        model.parameters.cohesion = 0.001;
        in_both_precisions([&]<class Real>(Real) {
            const auto state = run<Real>(model, 1);
            const double speed = state.velocity[1].x();
            if (r > 0.101)
                EXPECT_LT(speed, -1e-4) << r;
            else if (r < 0.099)
                EXPECT_GT(speed, 1e-4) << r;
            else
                EXPECT_NEAR(speed, 0, 2e-5);
            EXPECT_NEAR(state.velocity[0].x(), -speed, 1e-6 + 1e-5 * std::abs(speed));
        });
    }
}

/// A stretched block draws together, where without cohesion nothing moves; a net pull on itself would be wrong.
TEST_P(FluidParameters, CohesionHoldsAStretchedBlockTogether) {
    Model model = bare_model(GetParam(), lattice(4, 4, 4, 0.12), fluid_phase);
    for (int i = 0; i < model.particles(); ++i) model.inverse_mass[i] = 1 + (i % 3) * 0.5;
    model.parameters.damping = 10;
    in_both_precisions([&]<class Real>(Real) {
        model.parameters.cohesion = 0;
        EXPECT_NEAR(mean_gap(run<Real>(model, 120)), 0.12, 1e-6);
        model.parameters.cohesion = 0.002;
        const auto state = run<Real>(model, 120);
        EXPECT_LT(mean_gap(state), 0.11);
        EXPECT_GT(mean_gap(state), 0.06);
        const auto early = run<Real>(model, 10);
        if (GetParam() != Scheme::flex) {
            EXPECT_LT(momentum(model, early).norm(), (sizeof(Real) == 4 ? 1e-5 : 1e-12) * momentum_size(model, early));
        }
    });
}

/// Principal second moments of the particles about their mean, ascending.
template <class Real>
Eigen::Vector3d second_moments(const State<Real>& state) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const auto& x : state.position) mean += x.template cast<double>() / static_cast<double>(state.position.size());
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const auto& x : state.position) {
        const Eigen::Vector3d d = x.template cast<double>() - mean;
        sum += d * d.transpose();
    }
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum).eigenvalues();
}

/// An oblong drop in weightlessness draws itself round, and as a whole stays where it is.
TEST_P(FluidParameters, SurfaceTensionMakesADropRounder) {
    Model model = bare_model(GetParam(), lattice(12, 6, 6, 0.1), fluid_phase);
    model.parameters.damping = 1;
    model.parameters.flex.viscosity = 8;
    const auto oblong = [&model]<class Real>(Real) {
        const auto state = run<Real>(model, 480);
        if (model.scheme != Scheme::flex) {
            EXPECT_LE(momentum(model, state).norm(), 1e-4 * momentum_size(model, state));
        }
        const Eigen::Vector3d moments = second_moments(state);
        return moments[2] / moments[0];
    };
    const double without = oblong(float{});
    model.parameters.surface_tension = 20;
    EXPECT_GT(without, 4);
    // Exact: 1. So many particles fill a ball of radius 0.469, which is round to half a particle: (0.519 / 0.419)^2.
    in_both_precisions([&]<class Real>(Real real) { EXPECT_LT(oblong(real), 1.53); });
}

/// Enstrophy of the vortex about z: sum of squared vorticity, estimated over neighbours with a kernel of its own.
template <class Real>
double enstrophy(const State<Real>& state) {
    double total = 0;
    for (std::size_t i = 0; i < state.position.size(); ++i) {
        Eigen::Matrix3d moment = Eigen::Matrix3d::Zero(), product = Eigen::Matrix3d::Zero();
        for (std::size_t j = 0; j < state.position.size(); ++j) {
            const Eigen::Vector3d d = (state.position[j] - state.position[i]).template cast<double>();
            if (i == j || d.norm() > 0.2) continue;
            moment += d * d.transpose();
            product += (state.velocity[j] - state.velocity[i]).template cast<double>() * d.transpose();
        }
        const Eigen::Matrix3d gradient = product * moment.completeOrthogonalDecomposition().pseudoInverse();
        const Eigen::Vector3d curl(gradient(2, 1) - gradient(1, 2), gradient(0, 2) - gradient(2, 0),
                                   gradient(1, 0) - gradient(0, 1));
        total += curl.squaredNorm();
    }
    return total;
}

/// A Taylor-Green vortex in a closed box loses less of its vorticity with confinement.
TEST_P(FluidParameters, VorticityConfinementKeepsVorticesAlive) {
    constexpr int n = 12;
    const double half = 0.5 * n * 0.1;
    Model model = bare_model(GetParam(), lattice(n, n, 4, 0.1), fluid_phase);
    model.parameters.flex.viscosity = 8;
    model.parameters.conserving.kinematic_viscosity = 0.05;  // in scheme conserving
    const double wall = half - 0.05 + model.parameters.collision_distance;
    for (const Eigen::Vector3d& axis : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0)})
        for (const double side : {-1.0, 1.0}) model.planes.push_back({side * axis, wall});
    for (const double side : {-1.0, 1.0}) model.planes.push_back({{0, 0, side}, 0.2});
    for (int i = 0; i < model.particles(); ++i) {
        const Eigen::Vector3d x = M_PI / 2 / half * model.position[i];
        model.velocity[i] = {-std::cos(x.x()) * std::sin(x.y()), std::sin(x.x()) * std::cos(x.y()), 0};
    }
    const auto lost = [&]<class Real>(Real) {
        return 1 - enstrophy(run<Real>(model, 24)) / enstrophy(initial_state<Real>(model));
    };
    const double without = lost(float{});
    model.parameters.vorticity_confinement = 0.2;
    in_both_precisions([&]<class Real>(Real real) {
        const double with = lost(real);
        EXPECT_LT(with, 0.6 * without);
        EXPECT_GT(with, 0);
    });
}

/// A lone fluid particle lacks nearly all of the rest density and is slowed the more, exactly by the drag on what it
/// lacks; one inside fluid keeps its speed. Only the first substep: later the fluid around passes on what it feels.
TEST_P(FluidParameters, FreeSurfaceDragActsOnWhatHasFewNeighbours) {
    Model drop = bare_model(GetParam(), {{0, 0, 0}}, fluid_phase);
    drop.velocity[0] = {0, -1, 0};
    Model block = bare_model(GetParam(), lattice(7, 7, 7, 0.085), fluid_phase);
    for (auto& v : block.velocity) v = {0, -1, 0};
    const int middle = (block.particles() - 1) / 2;
    drop.parameters.free_surface_drag = block.parameters.free_surface_drag = 1 / substep;
    in_both_precisions([&]<class Real>(Real) {
        Solver<Real> solver(drop);
        State<Real> state = initial_state<Real>(drop);
        advance(solver, state, 1);
        const double alone = -state.velocity[0].y();
        const double lacking = 1 - solver.densities()[0];
        EXPECT_GT(lacking, 0.2);
        EXPECT_NEAR(alone, 1 / (1 + lacking), 1e-5);
        const double inside = -run<Real>(block, 1).velocity[middle].y();
        EXPECT_GT(inside, 0.99);  // exact: 1, it lacks nothing
        EXPECT_GT(inside, alone + 0.1);
    });
}

INSTANTIATE_TEST_SUITE_P(Schemes, FluidParameters, testing::Values(Scheme::flex, Scheme::conserving), scheme_name);

}  // namespace
}  // namespace natator
