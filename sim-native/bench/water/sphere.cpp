#include <cmath>
#include <numbers>

#include "model/cluster.h"
#include "water/water_tank.h"

namespace natator::bench {
namespace {

/// What a sphere of this density (of the water's) does in a tank so many lengths high once it is let go.
struct Fall {
    double density = 1;
    double radius = 0.3;
    double start = 1;   ///< height of the centre
    double height = 2;  ///< of the water
    double viscosity = 0;
    double duration = 1;  ///< s
};

/// Particles within the sphere become a rigid body that displaces just the water that was there.
void immerse_sphere(const Eigen::Vector3d& centre, double radius, Model& model) {
    std::vector<int> sphere;
    for (int i = 0; i < model.particles(); ++i) {
        if ((model.position[i] - centre).norm() > radius) continue;
        model.phase[i] = 1;
        model.inverse_mass[i] = 0;  // until it is let go
        sphere.push_back(i);
    }
    model.clusters = {make_cluster(sphere, model.position, 1)};
}

/// Of a sphere of the volume that the body displaces.
double diameter(const Model& model) {
    const double volume = static_cast<double>(model.clusters[0].particles.size()) *
                          std::pow(model.parameters.fluidRestDistance, 3);
    return std::cbrt(6 * volume / std::numbers::pi);
}

template <class Real>
double height(const Model& model, const State<Real>& state) {
    double sum = 0;
    for (const int i : model.clusters[0].particles) sum += static_cast<double>(state.position[i].y());
    return sum / static_cast<double>(model.clusters[0].particles.size());
}

/// The curve is how far the sphere has fallen, length.
template <class Real>
WaterRun let_go(const Fall& fall, const WaterSetting& setting, double& sphere_diameter) {
    const auto layers = static_cast<int>(std::lround(fall.height / water_length * setting.resolution));
    const Eigen::Vector3d centre(water_length / 2, fall.start, water_length / 2);
    WaterTank<Real> tank({setting.resolution, layers, setting.resolution}, setting,
                         [&](Model& model) { immerse_sphere(centre, fall.radius, model); });
    sphere_diameter = diameter(tank.model());
    tank.change([&](Model& model) {
        model.parameters.kinematicViscosity = fall.viscosity;
        for (const int i : model.clusters[0].particles) model.inverse_mass[i] = 1 / fall.density;
    });
    const double start = height(tank.model(), tank.state());
    std::vector<WaterSample> curve{{0, 0}};
    const long frames = std::lround(fall.duration / tank.model().time_step);
    for (long frame = 1; frame <= frames && tank.frame(); ++frame)
        curve.push_back({static_cast<double>(frame) * tank.model().time_step,
                         start - height(tank.model(), tank.state())});
    WaterRun run = tank.run();
    run.curve = curve;
    return run;
}

WaterRun let_go(const Fall& fall, const WaterSetting& setting, double& sphere_diameter) {
    return in_precision(
        setting, [&](const WaterSetting& own) { return let_go<float>(fall, own, sphere_diameter); },
        [&](const WaterSetting& own) { return let_go<double>(fall, own, sphere_diameter); });
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

/// Schiller and Naumann (1933).
double drag_coefficient(double reynolds) {
    return 24 / reynolds * (1 + 0.15 * std::pow(reynolds, 0.687));
}

}  // namespace

/// A sphere as heavy as the water that it displaces: what it moves by is as if its weight were wrong by so much.
WaterRun run_neutral_sphere(const WaterSetting& setting) {
    double sphere_diameter = 0;
    WaterRun run = let_go({.density = 1, .duration = 1}, setting, sphere_diameter);
    if (run.instability) return run;
    const double error = acceleration(run.curve) * (1 + added_mass) / gravity;
    run.figures = {{.value = error, .reference = 0, .least = -0.01, .greatest = 0.01}};
    return run;
}

/// Let go in water at rest, a sphere accelerates as if it had half of the displaced water's mass too.
WaterRun run_added_mass(const WaterSetting& setting) {
    const Fall fall{.density = 2, .duration = 0.15};
    double sphere_diameter = 0;
    WaterRun run = let_go(fall, setting, sphere_diameter);
    if (run.instability) return run;
    const double measured = (fall.density - 1) * gravity / acceleration(run.curve) - fall.density;
    run.figures = {{.value = measured, .reference = added_mass, .least = 0.9 * added_mass, .greatest = 1.1 * added_mass}};
    return run;
}

/// The drag at the speed that a sphere falls with in the end.
WaterRun run_falling_sphere(const WaterSetting& setting) {
    const Fall fall{
        .density = 1.05, .radius = 0.2, .start = 2.5, .height = 3, .viscosity = 0.02, .duration = 8};
    double sphere_diameter = 0;
    WaterRun run = let_go(fall, setting, sphere_diameter);
    if (run.instability) return run;
    // Over the last two fifths of the time in which it is not near the floor.
    const double free_way = 0.75 * (fall.start - fall.radius);
    auto end = run.curve.begin();
    while (end + 1 != run.curve.end() && end->value < free_way) ++end;
    const auto begin = run.curve.begin() + (end - run.curve.begin()) * 3 / 5;
    const double speed = (end->value - begin->value) / (end->time - begin->time);
    const double drag = 4.0 / 3 * (fall.density - 1) * gravity * sphere_diameter / (speed * speed);
    const double reynolds = speed * sphere_diameter / fall.viscosity, reference = drag_coefficient(reynolds);
    run.figures = {{.value = drag, .reference = reference, .least = 0.9 * reference, .greatest = 1.1 * reference},
                   {.value = reynolds, .reference = reynolds}};
    return run;
}

}  // namespace natator::bench
