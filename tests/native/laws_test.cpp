// Laws that scheme conserving keeps, each against its closed form or its exact symmetry.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "energy.h"
#include "fluid_column.h"
#include "natator/model_builder.h"
#include "natator/momentum.h"
#include "natator/solver.h"
#include "scene/scene_json.h"

namespace natator {
namespace {

using namespace test;

Gait strongest_gait(const Model& model) {
    Gait gait;
    gait.frequency = 2;
    for (int i = 0; i < model.actuators; ++i) {
        gait.amplitude.push_back(1);
        gait.phase.push_back(std::fmod(0.3 * i, 1.0));
    }
    return gait;
}

template <class Real>
void expect_momentum_kept(int creature, double bound) {
    Scene scene = load_scene("thesis/creature-" + std::to_string(creature) + "-vacuum");
    scene.scheme = Scheme::conserving;
    const Model model = build_model(scene);
    const Gait gait = strongest_gait(model);
    Solver<Real> solver(model);
    State<Real> state = initial_state<Real>(model);
    double linear = 0, angular = 0, linear_size = 0, angular_size = 0;
    for (int frame = 0; frame < 240; ++frame) {
        ASSERT_FALSE(solver.frame(state, gait));
        const Momentum now = measure_momentum(model, state);
        linear = std::max(linear, now.linear);
        angular = std::max(angular, now.angular);
        linear_size = std::max(linear_size, now.linear_size);
        angular_size = std::max(angular_size, now.angular_size);
    }
    ASSERT_GT(linear_size, 1);
    EXPECT_LE(linear / linear_size, bound) << "linear";
    EXPECT_LE(angular / angular_size, bound) << "angular";
}

/// Internal forces alone: the momenta stay at 0, measured against the largest sums of their parts' sizes.
class NoSwimmingInVacuum : public testing::TestWithParam<int> {};
TEST_P(NoSwimmingInVacuum, MomentumIsKeptInFloat) {
    expect_momentum_kept<float>(GetParam(), 1e-6);
}
TEST_P(NoSwimmingInVacuum, MomentumIsKeptInDouble) {
    expect_momentum_kept<double>(GetParam(), 1e-12);
}
INSTANTIATE_TEST_SUITE_P(Creatures, NoSwimmingInVacuum, testing::Values(1, 2, 3, 4));

/// Hydrostatics, p(y) = rho g (H - y) with rho g = weight / volume: density at the bottom 1, pressure there the weight
/// per area, height that of the lattice; and the column comes to rest.
TEST(Hydrostatics, AColumnStandsAsItsClosedFormSays) {
    const int width = 8, layers = 20;
    const Model model = fluid_column(width, layers, 16, 1);
    Solver<float> solver(model);
    State<float> state = initial_state<float>(model);
    double largest_kinetic = 0;
    for (int k = 0; k < 180; ++k) {
        ASSERT_FALSE(solver.update(state, frame, model.parameters.substeps));
        largest_kinetic = std::max(largest_kinetic, kinetic_energy(model, state));
    }
    // Mean pressure over half a second, by height.
    std::vector<double> pressure(layers, 0), samples(layers, 0), density(layers, 0);
    double mean_height = 0;
    const double side = model.planes[3].offset;
    for (int k = 0; k < 60; ++k) {
        ASSERT_FALSE(solver.update(state, frame, model.parameters.substeps));
        const auto pressures = solver.pressures();
        const auto densities = solver.densities();
        for (int i = 0; i < model.particles(); ++i) {
            mean_height += state.position[i].y() / (60.0 * model.particles());
            const int layer = static_cast<int>(state.position[i].y() / 0.09f);
            const auto from_wall = [side](float x) { return std::min(double(x), side - double(x)); };
            const double wall = std::min(from_wall(state.position[i].x()), from_wall(state.position[i].z()));
            if (layer < 0 || layer >= layers || wall < model.parameters.radius) continue;
            pressure[layer] += static_cast<double>(pressures[i]);
            density[layer] += static_cast<double>(densities[i]);
            samples[layer] += 1;
        }
    }
    EXPECT_LT(kinetic_energy(model, state), largest_kinetic / 100);
    const double height = 2 * mean_height;
    EXPECT_NEAR(height, layers * 0.09, 0.02 * layers * 0.09);

    // A line through the mean pressures of the inner layers, continued to the floor.
    double n = 0, sum_y = 0, sum_p = 0, sum_yy = 0, sum_yp = 0;
    for (int layer = 2; layer < layers - 4; ++layer) {
        const double y = (layer + 0.5) * 0.09, p = pressure[layer] / samples[layer];
        n += 1;
        sum_y += y;
        sum_p += p;
        sum_yy += y * y;
        sum_yp += y * p;
        EXPECT_NEAR(density[layer] / samples[layer], 1, 0.01) << layer;
    }
    const double slope = (n * sum_yp - sum_y * sum_p) / (n * sum_yy - sum_y * sum_y);
    const double at_floor = (sum_p - slope * sum_y) / n;
    const double area = std::pow(width * 0.09, 2);
    const double weight = 10.0 * model.particles();
    EXPECT_NEAR(at_floor, weight / area, 0.01 * weight / area);
}

/// A chain that swings from its held end: energy is only lost.
TEST(Energy, AHangingChainNeverGainsAny) {
    const Model model = hanging_chain();
    Solver<double> solver(model);
    State<double> state = initial_state<double>(model);
    double last = total_energy(model, state);
    const double fall = 10.0 * 11 * 0.6;  // energy set free until the chain hangs down
    for (int k = 0; k < 240; ++k) {
        ASSERT_FALSE(solver.update(state, frame, 16));
        const double now = total_energy(model, state);
        EXPECT_LE(now, last + 1e-3 * fall) << k;
        last = now;
    }
}

/// A block of fluid that collapses in its tank: energy is only lost.
TEST(Energy, ACollapsingBlockNeverGainsAny) {
    const Model model = collapsing_block();
    Solver<float> solver(model);
    State<float> state = initial_state<float>(model);
    for (int k = 0; k < 100; ++k) {  // settling, as the thesis' scenes do
        ASSERT_FALSE(solver.update(state, 1e-4, 1));
        for (auto& v : state.velocity) v.setZero();
    }
    double last = total_energy(model, state);
    const double fall = last / 2;
    for (int k = 0; k < 180; ++k) {
        ASSERT_FALSE(solver.update(state, frame, model.parameters.substeps));
        const double now = total_energy(model, state);
        EXPECT_LE(now, last + 5e-3 * fall) << k;
        last = now;
    }
}

/// A drop in free space keeps its momenta, whatever goes on inside it.
TEST(Momentum, ADropWithUnequalMassesKeepsItsMomentum) {
    const Model model = drop_of_unequal_masses();
    Solver<double> solver(model);
    State<double> state = initial_state<double>(model);
    Eigen::Vector3d before = Eigen::Vector3d::Zero(), after = Eigen::Vector3d::Zero();
    for (int i = 0; i < model.particles(); ++i) before += state.velocity[i] / model.inverse_mass[i];
    for (int k = 0; k < 60; ++k) ASSERT_FALSE(solver.update(state, frame, 4));
    for (int i = 0; i < model.particles(); ++i) after += state.velocity[i] / model.inverse_mass[i];
    EXPECT_LE((after - before).norm(), 1e-12 * measure_momentum(model, state).linear_size);
}

template <class Change>
State<double> swim(const Scene& scene, double duration, const Change& change) {
    Model model = build_model(scene);
    Gait gait;
    gait.frequency = 1.861;
    gait.amplitude = {0.973, 0.69};
    gait.phase = {0, 0.648};
    change(model, gait);
    Solver<double> solver(model);
    State<double> state = initial_state<double>(model);
    for (int k = 0; k < std::lround(duration / frame); ++k) EXPECT_FALSE(solver.frame(state, gait));
    return state;
}

/// The same motion seen from a frame that moves at a constant velocity.
TEST(Symmetry, GalileanInvariance) {
    Scene scene = load_scene("thesis/creature-1-vacuum");
    scene.scheme = Scheme::conserving;
    scene.solver.damping = 0;
    const Eigen::Vector3d drift(0.5, -0.25, 0.125);
    const double duration = 0.5;
    const auto at_rest = swim(scene, duration, [](Model&, Gait&) {});
    const auto moving = swim(scene, duration, [&](Model& model, Gait&) {
        for (auto& v : model.velocity) v = drift;
    });
    for (std::size_t i = 0; i < at_rest.position.size(); ++i)
        EXPECT_LE((moving.position[i] - drift * duration - at_rest.position[i]).norm(), 1e-9) << i;
}

/// A gait mirrored left to right, half a turn later for every muscle, swims the mirrored path through mirrored water.
TEST(Symmetry, AMirroredGaitSwimsTheMirroredPath) {
    Scene scene = load_scene("thesis/creature-1");
    scene.scheme = Scheme::conserving;
    scene.creature->rear_centre.z() = 0.77;  // in the middle of the tank
    const auto path = swim(scene, 0.25, [](Model&, Gait&) {});
    const auto mirrored = swim(scene, 0.25, [](Model&, Gait& gait) {
        for (double& phase : gait.phase) phase = std::fmod(phase + 0.5, 1.0);
    });
    const Model model = build_model(scene);
    for (const auto& slice : model.body.slices) {
        Eigen::Vector3d a = Eigen::Vector3d::Zero(), b = Eigen::Vector3d::Zero();
        for (const int i : slice) {
            a += path.position[i] / double(slice.size());
            b += mirrored.position[i] / double(slice.size());
        }
        EXPECT_NEAR(a.x(), b.x(), 1e-6);
        EXPECT_NEAR(a.y(), b.y(), 1e-6);
        EXPECT_NEAR(a.z() - 0.77, 0.77 - b.z(), 1e-6);
    }
}

}  // namespace
}  // namespace natator
