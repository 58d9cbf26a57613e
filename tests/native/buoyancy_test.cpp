// Bodies in fluid under gravity, scheme conserving: what floats, how deep, and that a tank comes to rest.
//
// The fluid has the density of its particles' mass over the volume that each takes, close to fluidRestDistance^3 /
// sqrt(2). A body has no volume of its own: its particles keep the fluid's at solidRestDistance, so it displaces what
// lies within that distance of them, less half the fluid's spacing, since fluid fills the space around its particles.
// For a small body this is far more than its particles' lattice takes: 2.0 times for 3^3 of them, 1.45 times for 6^3.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "energy.h"
#include "evaluate/settle.h"
#include "fluid_column.h"
#include "model/cluster.h"
#include "natator/model_builder.h"
#include "natator/solver.h"
#include "scene/scene_json.h"

namespace natator {
namespace {

using namespace test;

double mean_height(const State<float>& state, int first, int last) {
    double sum = 0;
    for (int i = first; i < last; ++i) sum += static_cast<double>(state.position[i].y());
    return sum / (last - first);
}

/// A cube of solid particles, held together by one stiff cluster, in the middle of a tank.
struct CubeInTank {
    Model model;  ///< fluid first
    int fluid = 0;
    double volume = 0;  ///< that it should displace: rounded edges and corners

    CubeInTank(const Model& tank, double side, double scale) : model(tank) {
        const double spacing = 0.1 * scale;
        const int count = static_cast<int>(std::lround(side / spacing));
        const double half = (count - 1) * spacing / 2;
        const Eigen::Vector3d middle(tank.planes[3].offset / 2, tank.position.back().y() / 2,
                                     tank.planes[4].offset / 2);
        model.position.clear();
        for (const Eigen::Vector3d& x : tank.position) {
            const Eigen::Vector3d outside = ((x - middle).cwiseAbs().array() - half).max(0);
            if (outside.norm() > model.parameters.solidRestDistance) model.position.push_back(x);
        }
        fluid = model.particles();
        for (int x = 0; x < count; ++x)
            for (int y = 0; y < count; ++y)
                for (int z = 0; z < count; ++z)
                    model.position.push_back(middle + spacing * Eigen::Vector3d(x, y, z) -
                                             Eigen::Vector3d::Constant(half));
        const auto all = static_cast<std::size_t>(model.particles());
        model.velocity.assign(all, Eigen::Vector3d::Zero());
        model.inverse_mass.resize(all);
        model.phase.resize(all);
        std::vector<int> cube;
        for (int i = fluid; i < model.particles(); ++i) {
            model.phase[i] = 1;
            cube.push_back(i);
        }
        model.clusters.push_back(make_cluster(cube, model.position, 1));
        set_mass(std::numeric_limits<double>::infinity());

        const double edge = 2 * half, reach = model.parameters.solidRestDistance - 0.0445 * scale;
        volume = std::pow(edge, 3) + 6 * edge * edge * reach +
                 std::numbers::pi * (3 * edge * reach * reach + 4.0 / 3 * std::pow(reach, 3));
    }

    void set_mass(double mass) {
        for (int i = fluid; i < model.particles(); ++i) model.inverse_mass[i] = (model.particles() - fluid) / mass;
    }
};

/// Fluid at rest is a packing of particles that carries a small body up to some tenths too heavy or too light, as sand
/// does. So the fluid is stirred: random kicks, as large as a small swimmer's speed, let it flow.
class Stirred {
public:
    explicit Stirred(const Model& model, int fluid) : solver_(model), model_(model), fluid_(fluid) {}

    /// Mean height of the fluid over the second half of the time (s).
    double run(State<float>& state, double duration) {
        const int frames = static_cast<int>(std::lround(duration / frame));
        double sum = 0;
        for (int k = 0; k < frames; ++k) {
            for (int i = 0; i < fluid_; ++i) state.velocity[i] += Vector3<float>(kick(), kick(), kick());
            EXPECT_FALSE(solver_.update(state, frame, model_.parameters.substeps));
            if (k >= frames / 2) sum += mean_height(state, 0, fluid_);
        }
        return sum / (frames - frames / 2);
    }

private:
    float kick() { return 0.7f * (static_cast<float>(random_()) / 2147483648.0f - 1); }

    Solver<float> solver_;
    const Model& model_;
    int fluid_;
    std::mt19937 random_{1};
};

/// Volume that a body at height `y` displaces, from how far it lifts the fluid's mean height: with the fluid's volume
/// F, F y_fluid = (F + V)^2 / 2A - V y.
double displaced_volume(double fluid_volume, double area, double fluid_height, double y) {
    const double p = area * y - fluid_volume;
    return p + std::sqrt(p * p - fluid_volume * fluid_volume + 2 * area * fluid_volume * fluid_height);
}

class Buoyancy : public testing::TestWithParam<double> {};

/// Archimedes: a body hovers when it weighs as much as the fluid that it displaces, whatever the number of particles.
/// Displaced volume: measured with the body held. Where its surface lies is uncertain by a part of a particle, so the
/// tolerance shrinks with the particles: a fifth at 27 particles and 1000 of fluid, a tenth at eight times as many.
TEST_P(Buoyancy, FollowsDensityAndNotParticleCount) {
    const double scale = GetParam(), tolerance = 0.2 * scale;
    const int width = static_cast<int>(10 / scale), layers = static_cast<int>(12 / scale);
    const Model tank = fluid_column(width, layers, 4, 4, scale);
    const double area = tank.planes[3].offset * tank.planes[4].offset;
    State<float> water = initial_state<float>(tank);
    const double per_particle = 2 * Stirred(tank, tank.particles()).run(water, 1) * area / tank.particles();

    CubeInTank cube(tank, 0.3, scale);
    State<float> start = initial_state<float>(cube.model);
    const double y = mean_height(start, cube.fluid, cube.model.particles());
    const double fluid_height = Stirred(cube.model, cube.fluid).run(start, 1);
    const double volume = displaced_volume(cube.fluid * per_particle, area, fluid_height, y);
    EXPECT_NEAR(volume, cube.volume, 0.2 * cube.volume);

    const double displaced_mass = volume / per_particle / tank.inverse_mass[0];
    const auto rise = [&](double mass) {
        cube.set_mass(mass);
        State<float> state = start;
        Stirred(cube.model, cube.fluid).run(state, 0.75);
        return mean_height(state, cube.fluid, cube.model.particles()) - y;
    };
    EXPECT_GT(rise((1 - tolerance) * displaced_mass), 0.005);
    EXPECT_LT(rise((1 + tolerance) * displaced_mass), -0.005);
}
INSTANTIATE_TEST_SUITE_P(Particles, Buoyancy, testing::Values(1, 0.5),
                         [](const auto& test) { return test.param == 1 ? "Once" : "EightTimes"; });

/// Mean height of the thesis' swimmer with slack muscles after 1.5 s.
double floating_height(int substeps, int iterations) {
    Scene scene = load_scene("thesis/creature-1");
    scene.scheme = Scheme::conserving;
    scene.solver.substeps = substeps;
    scene.solver.numIterations = iterations;
    const Model model = build_model(scene);
    Gait slack;
    slack.frequency = 1;
    slack.amplitude.assign(static_cast<std::size_t>(model.actuators), 0);
    slack.phase = slack.amplitude;
    Solver<float> solver(model);
    State<float> state = initial_state<float>(model);
    EXPECT_FALSE(settle(scene.settling, solver, state));
    for (int k = 0; k < 90; ++k) EXPECT_FALSE(solver.frame(state, slack));
    return mean_height(state, 0, static_cast<int>(model.body.particles.size()));
}

/// The swimmer sinks from 0.6 to the layer of its density; scheme flex is up to 0.023 apart in these settings.
TEST(FloatingDepth, DoesNotDependOnTheSubsteps) {
    const double height = floating_height(4, 4);
    EXPECT_LT(height, 0.5);
    EXPECT_NEAR(floating_height(8, 4), height, 0.005);
    EXPECT_NEAR(floating_height(16, 1), height, 0.005);
}

/// Largest kinetic energy of a tank of fluid in 4 s over the mean of its last half second.
double calming(Scheme scheme) {
    Scene scene = load_scene("bench/small-tank");
    scene.scheme = scheme;
    scene.creature.reset();
    const Model model = build_model(scene);
    Solver<float> solver(model);
    State<float> state = initial_state<float>(model);
    EXPECT_FALSE(settle(scene.settling, solver, state));
    double largest = 0, last = 0;
    for (int k = 0; k < 240; ++k) {
        EXPECT_FALSE(solver.update(state, model.time_step, model.parameters.substeps));
        largest = std::max(largest, kinetic_energy(model, state));
        if (k >= 210) last += kinetic_energy(model, state) / 30;
    }
    return largest / last;
}

/// A tank let go comes to rest; with scheme flex it goes on to simmer.
TEST(Rest, ATankComesToRest) {
    EXPECT_GT(calming(Scheme::conserving), 100);
    EXPECT_LT(calming(Scheme::flex), 100);
}

}  // namespace
}  // namespace natator
