#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "model/cluster.h"
#include "water/drag_law.h"
#include "water/water_tank.h"

namespace natator::bench {
namespace {

/// What the curve of a fall shows.
enum class FallQuantity { way, speed };

/// What a sphere of this density (of the water's) does in a tank as wide and high as long once it is let go.
struct Fall {
    double density = 1;
    double duration = 1;  ///< s
    FallQuantity curve = FallQuantity::way;
};

/// Particles within the sphere become a rigid body that displaces just the water that was there, held until it is let
/// go.
void immerse_sphere(const Eigen::Vector3d& centre, Model& model) {
    const auto sphere =
        hold([&](const Eigen::Vector3d& x) { return (x - centre).norm() <= 0.15 * water_length; }, model);
    model.clusters = {make_cluster(sphere, model.position, 1)};
}

/// Of a sphere of the volume that the body displaces.
double diameter(const Model& model) {
    return diameter_of_sphere(static_cast<double>(model.clusters[0].particles.size()) *
                              std::pow(model.parameters.fluid_rest_distance, 3));
}

/// The mean over the sphere's particles of vectors that all particles have.
template <class Real>
Eigen::Vector3d mean_of_sphere(const std::vector<Vector3<Real>>& of_all, const Model& model) {
    const auto& sphere = model.clusters[0].particles;
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int i : sphere) sum += of_all[i].template cast<double>();
    return sum / static_cast<double>(sphere.size());
}

/// The curve is how far the sphere has fallen, length, or how fast it falls, length/s.
template <class Real>
WaterRun follow(double duration, FallQuantity what, WaterTank<Real>& tank) {
    const auto height = [&] { return mean_of_sphere(tank.state().position, tank.model()).y(); };
    if (what == FallQuantity::speed)
        return tank.follow(duration, [&] { return -mean_of_sphere(tank.state().velocity, tank.model()).y(); });
    return tank.follow(duration, [&, start = height()] { return start - height(); });
}

/// s, before it is let go: without the damping that has brought it to rest, water first bobs up and down, three times a
/// second, and a sphere that is free goes with it.
constexpr double held = 1.5;

/// Of the sphere, of the water's: lets it go.
template <class Real>
void set_density(double density, WaterTank<Real>& tank) {
    tank.change([&](Model& model) {
        for (const int i : model.clusters[0].particles) model.inverse_mass[i] = 1 / density;
    });
}

template <class Real>
WaterRun let_go(const Fall& fall, const WaterSetting& setting) {
    WaterTank<Real> tank(Eigen::Vector3i::Constant(setting.resolution), setting,
                         [&](Model& model) { immerse_sphere(Eigen::Vector3d::Constant(water_length / 2), model); });
    for (long k = 0; k < std::lround(held / tank.model().time_step); ++k)
        if (!tank.frame()) return tank.run();
    set_density(fall.density, tank);
    return follow(fall.duration, fall.curve, tank);
}

WaterRun let_go(const Fall& fall, const WaterSetting& setting) {
    return in_precision(setting.solver.precision, [&](auto real) { return let_go<decltype(real)>(fall, setting); });
}

constexpr double gravity = 10;

/// Of a fall from rest: x = a t^2 / 2, by least squares.
double acceleration(const std::vector<WaterSample>& curve) {
    double numerator = 0, denominator = 0;
    for (const WaterSample& sample : curve) {
        const double square = sample.time * sample.time / 2;
        numerator += sample.value * square;
        denominator += square * square;
    }
    return numerator / denominator;
}

constexpr double added_mass = 0.5;  ///< of a sphere, of the mass that it displaces (Lamb, art. 92)

/// A sphere in a tank 1.4 lengths wide and 1.8 high that is let go so much denser than its water, in parts of that.
struct Release {
    double excess;
    double start;  ///< height of the middle
};

constexpr double release_gravity = 8, release_viscosity = 0.008, release_duration = 8;  // s
constexpr double release_width = 1.4 * water_length, release_height = 1.8 * water_length;
constexpr double counted = 2;  ///< s, at the end

/// The same by Schiller and Naumann's drag, and the history of its drag (Mei and Adrian), on a sphere that carries its
/// added mass along: speed over the last `counted`. Half the step changes it by 0.2 %.
double expected_speed(double excess, double sphere_diameter) {
    constexpr double step = 4e-3;
    const double of_history = 18 * release_viscosity / (sphere_diameter * sphere_diameter);
    double speed = 1e-6, way = 0;
    std::vector<double> changes;  // of the speed, in each step
    for (double time = 0; time < release_duration; time += step) {
        // At the speed at which the water passes between sphere and walls.
        const double drag = drag_of_sphere(speed * sphere_diameter / release_viscosity);
        const double between = blockage_of_sphere(drag, sphere_diameter, release_width * release_width);
        const double passing = speed * (1 + std::min(between, 0.2));
        double held_back =
            0.75 / sphere_diameter * passing * passing * drag_of_sphere(passing * sphere_diameter / release_viscosity);
        for (std::size_t k = 0; k < changes.size(); ++k)
            held_back += of_history * changes[k] *
                         history_of_drag(time - (static_cast<double>(k) + 0.5) * step, speed, sphere_diameter,
                                         release_viscosity);
        // The change of this step acts on itself: by the integral of Basset's part over it.
        const double own =
            of_history * 2 * std::sqrt(step) * sphere_diameter / std::sqrt(4 * std::numbers::pi * release_viscosity);
        changes.push_back(step * (excess * release_gravity - held_back) / (1 + excess + added_mass + own));
        speed += changes.back();
        if (time >= release_duration - counted) way += step * speed;
    }
    return way / counted;
}

template <class Real>
WaterRun release(const Release& how, const WaterSetting& setting) {
    const int across = particles_along(release_width, setting), up = particles_along(release_height, setting);
    WaterTank<Real> tank({across, up, across}, setting, [&](Model& model) {
        model.parameters.gravity = {0, -release_gravity, 0};
        immerse_sphere({release_width / 2, how.start, release_width / 2}, model);
    });
    const double sphere_diameter = diameter(tank.model());
    if (!tank.set_kinematic_viscosity(release_viscosity)) return tank.run();
    set_density(1 + how.excess, tank);
    WaterRun run = follow(release_duration, FallQuantity::way, tank);
    if (run.instability) return run;
    const auto frames_counted = static_cast<std::size_t>(std::lround(counted / tank.model().time_step));
    const WaterSample& begin = run.curve[run.curve.size() - 1 - frames_counted];
    const double expected = expected_speed(std::abs(how.excess), sphere_diameter);
    const double speed = (run.curve.back().value - begin.value) / counted * (how.excess > 0 ? 1 : -1);
    run.figures = {figure_within(0.2, speed, expected)};
    return run;
}

WaterRun release(const Release& how, const WaterSetting& setting) {
    return in_precision(setting.solver.precision, [&](auto real) { return release<decltype(real)>(how, setting); });
}

}  // namespace

/// A sphere as heavy as the water that it displaces: what it moves by is as if its weight were wrong by so much.
WaterRun run_neutral_sphere(const WaterSetting& setting) {
    WaterRun run = let_go({.density = 1, .duration = 1}, setting);
    if (run.instability) return run;
    const double error = acceleration(run.curve) * (1 + added_mass) / gravity;
    run.figures = {{.value = error, .reference = 0, .least = -0.01, .greatest = 0.01}};
    return run;
}

/// Let go in water at rest, a sphere accelerates as if it had half of the displaced water's mass too: by its speed, as
/// its way is longer by half a substep, and before it has enough of that for a drag.
WaterRun run_added_mass(const WaterSetting& setting) {
    const Fall fall{.density = 2, .duration = 0.05, .curve = FallQuantity::speed};
    WaterRun run = let_go(fall, setting);
    if (run.instability) return run;
    const double acceleration = run.curve.back().value / fall.duration;
    run.figures = {figure_within(0.1, (fall.density - 1) * gravity / acceleration - fall.density, added_mass)};
    return run;
}

/// A hundredth heavier than its water, a sphere sinks.
WaterRun run_heavier_sphere(const WaterSetting& setting) {
    return release({.excess = 0.01, .start = 0.65 * release_height}, setting);
}

/// A hundredth lighter, it rises.
WaterRun run_lighter_sphere(const WaterSetting& setting) {
    return release({.excess = -0.01, .start = 0.35 * release_height}, setting);
}

}  // namespace natator::bench
