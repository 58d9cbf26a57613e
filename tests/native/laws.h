// Laws that scheme conserving keeps, each against its closed form or its exact symmetry, for any backend: what includes this
// names its solver and instantiates the suite.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "energy.h"
#include "law_models.h"
#include "natator/model_builder.h"
#include "natator/momentum.h"
#include "natator/solver.h"
#include "scene/scene_json.h"

namespace natator::test {

/// Backend::Solver<Real> computes, Backend::missing() says why it can't, if it can't.
template <class Backend>
class Laws : public testing::Test {
protected:
    template <class Real>
    using Solver = typename Backend::template Solver<Real>;

    void SetUp() override {
        if (const char* why = Backend::missing()) GTEST_SKIP() << why;
    }

    /// Internal forces alone: the momenta stay at 0, measured against the largest sums of their parts' sizes.
    template <class Real>
    static void expect_momentum_kept(int creature, double bound) {
        Scene scene = load_scene("thesis/creature-" + std::to_string(creature) + "-vacuum");
        scene.scheme = Scheme::conserving;
        const Model model = build_model(scene);
        Gait gait;
        gait.frequency = 2;
        for (int i = 0; i < model.actuators; ++i) {
            gait.amplitude.push_back(1);
            gait.phase.push_back(std::fmod(0.3 * i, 1.0));
        }
        Solver<Real> solver(model);
        State<Real> state = initial_state<Real>(model);
        double linear = 0, angular = 0, linear_size = 0, angular_size = 0;
        for (int k = 0; k < 240; ++k) {
            ASSERT_FALSE(solver.frame(state, gait));
            const Momentum now = measure_momentum(model, state);
            linear = std::max(linear, now.linear);
            angular = std::max(angular, now.angular);
            linear_size = std::max(linear_size, now.linear_size);
            angular_size = std::max(angular_size, now.angular_size);
        }
        ASSERT_GT(linear_size, 1);
        EXPECT_LE(linear / linear_size, bound) << "linear, creature " << creature;
        EXPECT_LE(angular / angular_size, bound) << "angular, creature " << creature;
    }

    /// The thesis' swimmer of two actuators.
    static State<double> swim(const Model& model, const Gait& gait, int frames) {
        Solver<double> solver(model);
        State<double> state = initial_state<double>(model);
        for (int k = 0; k < frames; ++k) EXPECT_FALSE(solver.frame(state, gait));
        return state;
    }
};
TYPED_TEST_SUITE_P(Laws);

inline const Gait two_joints{1.861, {0.973, 0.69}, {0, 0.648}, 1};

TYPED_TEST_P(Laws, NoSwimmingInVacuum) {
    for (const int creature : {1, 2, 3, 4}) {
        this->template expect_momentum_kept<float>(creature, 1e-6);
        this->template expect_momentum_kept<double>(creature, 1e-12);
    }
}

/// A drop in free space, whatever goes on inside it.
TYPED_TEST_P(Laws, ADropWithUnequalMassesKeepsItsMomentum) {
    const Model model = drop_of_unequal_masses();
    typename TypeParam::template Solver<double> solver(model);
    State<double> state = initial_state<double>(model);
    const auto momentum = [&] {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (int i = 0; i < model.particles(); ++i) sum += state.velocity[i] / model.inverse_mass[i];
        return sum;
    };
    const Eigen::Vector3d before = momentum();
    advance_frames(solver, model, state, 60);
    EXPECT_LE((momentum() - before).norm(), 1e-12 * measure_momentum(model, state).linear_size);
}

/// A column comes to rest at the height of its lattice, with the density of rest inside.
TYPED_TEST_P(Laws, AColumnStandsAtItsHeight) {
    const int width = 8, layers = 16;
    Model model = box_of_water({width, layers, width});
    model.parameters.substeps = 4;
    model.parameters.damping = 1;
    typename TypeParam::template Solver<float> solver(model);
    State<float> state = initial_state<float>(model);
    advance_frames(solver, model, state, 120);
    double mean_height = 0, density = 0;
    int inside = 0;
    const auto densities = solver.densities();
    for (int i = 0; i < model.particles(); ++i) {
        const double y = static_cast<double>(state.position[i].y());
        mean_height += y / model.particles();
        if (y > (layers - 3) * water_spacing) continue;
        density += static_cast<double>(densities[i]);
        ++inside;
    }
    EXPECT_NEAR(2 * mean_height, layers * water_spacing, 0.02 * layers * water_spacing);
    ASSERT_GT(inside, 100);
    EXPECT_NEAR(density / inside, 1, 0.01);
}

/// A block of water that collapses in its tank: what it falls is lost in the end, and none is gained but noise.
TYPED_TEST_P(Laws, ACollapsingBlockGainsNoEnergy) {
    const Model model = collapsing_block();
    typename TypeParam::template Solver<float> solver(model);
    State<float> state = initial_state<float>(model);
    for (int k = 0; k < 100; ++k) {  // settling, as the thesis' scenes do
        ASSERT_FALSE(solver.update(state, 1e-4, 1));
        for (auto& v : state.velocity) v.setZero();
    }
    const double start = total_energy(model, state);
    double last = start;
    for (int k = 0; k < 120; ++k) {
        advance_frames(solver, model, state, 1);
        const double now = total_energy(model, state);
        EXPECT_LE(now, last + 5e-3 * start) << k;
        last = now;
    }
    EXPECT_LT(last, 0.8 * start);
}

/// A chain that swings from its held end: no fluid, no contacts; energy is only lost.
TYPED_TEST_P(Laws, AHangingChainGainsNoEnergy) {
    const Model model = hanging_chain();
    typename TypeParam::template Solver<double> solver(model);
    State<double> state = initial_state<double>(model);
    double last = total_energy(model, state);
    const double fall = 10.0 * 11 * 0.6;  // energy set free until the chain hangs down
    for (int k = 0; k < 240; ++k) {
        ASSERT_FALSE(solver.update(state, model.time_step, 16));
        const double now = total_energy(model, state);
        EXPECT_LE(now, last + 1e-3 * fall) << k;
        last = now;
    }
    EXPECT_EQ(state.position[0], Eigen::Vector3d(0, 2, 0));
}

/// The same motion seen from a frame that moves at a constant velocity.
TYPED_TEST_P(Laws, GalileanInvariance) {
    Scene scene = load_scene("thesis/creature-1-vacuum");
    scene.scheme = Scheme::conserving;
    scene.solver.damping = 0;
    const Eigen::Vector3d drift(0.5, -0.25, 0.125);
    Model model = build_model(scene);
    const auto at_rest = this->swim(model, two_joints, 30);
    for (auto& v : model.velocity) v = drift;
    const auto moving = this->swim(model, two_joints, 30);
    for (std::size_t i = 0; i < at_rest.position.size(); ++i)
        EXPECT_LE((moving.position[i] - drift * 0.5 - at_rest.position[i]).norm(), 1e-9) << i;
}

/// A gait mirrored left to right, half a turn later for every muscle, swims the mirrored path through mirrored water.
TYPED_TEST_P(Laws, AMirroredGaitSwimsTheMirroredPath) {
    Scene scene = load_scene("thesis/creature-1");
    scene.scheme = Scheme::conserving;
    scene.creature->rear_centre.z() = 0.77;  // in the middle of the tank
    Model model = build_model(scene);
    const auto path = this->swim(model, two_joints, 15);
    for (int i = 0; i < model.particles(); ++i)
        if (model.is_fluid(i)) model.position[i].z() = 1.54 - model.position[i].z();
    Gait later = two_joints;
    for (double& phase : later.phase) phase = std::fmod(phase + 0.5, 1.0);
    const auto mirrored = this->swim(model, later, 15);
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

/// Archimedes: a body as heavy as the water that it displaces hovers, whatever the number of particles; a tenth heavier
/// it sinks, a tenth lighter it rises.
TYPED_TEST_P(Laws, BodiesFloatByTheirDensity) {
    for (const double scale : {1.0, 0.5}) {
        const auto rise = [&](double density) {
            Model model = cube_in_water(density, scale);
            model.parameters.substeps = 4;
            model.parameters.damping = 1;
            typename TypeParam::template Solver<float> solver(model);
            State<float> state = initial_state<float>(model);
            const auto height = [&] {
                double sum = 0;
                int solids = 0;
                for (int i = 0; i < model.particles(); ++i)
                    if (!model.is_fluid(i)) ++solids, sum += static_cast<double>(state.position[i].y());
                return sum / solids;
            };
            const double before = height();
            advance_frames(solver, model, state, 30);
            return height() - before;
        };
        EXPECT_NEAR(rise(1), 0, 0.01) << scale;
        EXPECT_GT(rise(0.9), 0.03) << scale;
        EXPECT_LT(rise(1.1), -0.03) << scale;
    }
}

/// Largest kinetic energy of a tank of water in 4 s over the mean of its last half second.
TYPED_TEST_P(Laws, ATankComesToRest) {
    Scene scene = load_scene("bench/small-tank");
    scene.scheme = Scheme::conserving;
    scene.creature.reset();
    const Model model = build_model(scene);
    typename TypeParam::template Solver<float> solver(model);
    State<float> state = initial_state<float>(model);
    double largest = 0, last = 0;
    for (int k = 0; k < 240; ++k) {
        advance_frames(solver, model, state, 1);
        largest = std::max(largest, kinetic_energy(model, state));
        if (k >= 210) last += kinetic_energy(model, state) / 30;
    }
    EXPECT_GT(largest, 100 * last);
}

REGISTER_TYPED_TEST_SUITE_P(Laws, NoSwimmingInVacuum, ADropWithUnequalMassesKeepsItsMomentum, AColumnStandsAtItsHeight,
                            ACollapsingBlockGainsNoEnergy, AHangingChainGainsNoEnergy, GalileanInvariance,
                            AMirroredGaitSwimsTheMirroredPath, BodiesFloatByTheirDensity, ATankComesToRest);

}  // namespace natator::test
