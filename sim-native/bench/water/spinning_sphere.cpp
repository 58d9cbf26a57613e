#include <cmath>
#include <numbers>

#include "water/water_tank.h"

namespace natator::bench {
namespace {

struct Spin {
    double viscosity;  ///< length^2/s
    double rate;       ///< 1/s
    double gravity;    ///< length/s^2
    double from;       ///< tau from which to twice of which the torque is taken
};

/// Of a sphere of radius R that begins to turn at once, in units of Kirchhoff's 8 pi mu R^3 spin, at the time
/// tau = nu t / R^2: from Lamb's torque on a sphere that swings (Hydrodynamics, art. 335).
double torque(double tau) {
    return 1 + (1 / std::sqrt(std::numbers::pi * tau) - std::exp(tau) * std::erfc(std::sqrt(tau))) / 3;
}

/// The mean over these times tells where water that flows along a body is at rest: the torque goes with the
/// third power of that radius, and no pressure is in it.
template <class Real>
WaterRun run_as(const Spin& spin, const WaterSetting& setting) {
    const double spacing = spacing_of(setting), radius = 0.2 * water_length;
    const int particles = particles_along(1.5 * water_length, setting);
    const Eigen::Vector3d middle = Eigen::Vector3d::Constant(particles * spacing / 2);
    std::vector<int> held;
    WaterTank<Real> tank(Eigen::Vector3i::Constant(particles), setting, [&](Model& model) {
        model.parameters.gravity = {0, -spin.gravity, 0};
        held = hold([&](const Eigen::Vector3d& x) { return (x - middle).norm() <= radius; }, model);
    });
    if (!tank.set_kinematic_viscosity(spin.viscosity)) return tank.run();
    const double volume = static_cast<double>(held.size()) * std::pow(spacing, 3);
    const double cube = volume * 3 / (4 * std::numbers::pi);  // of the radius
    const double unit = 8 * std::numbers::pi * spin.viscosity / std::pow(spacing, 3) * cube * spin.rate;
    std::vector<WaterSample> curve;
    double sum = 0, expected = 0;
    for (double time = tank.model().time_step;; time += tank.model().time_step) {
        const double tau = spin.viscosity * time / std::pow(cube, 2.0 / 3);
        Load load;
        if (tau > 2 * spin.from || !tank.drive({.spin = {0, 0, spin.rate}}, load)) break;
        curve.push_back({time, -load.moment.z() / unit});
        if (tau < spin.from) continue;
        sum += curve.back().value;
        expected += torque(tau);
    }
    WaterRun run = tank.run();
    if (run.instability) return run;
    run.curve = curve;
    run.figures = {figure_within(0.1, sum / expected, 1)};
    return run;
}

WaterRun run(const Spin& spin, const WaterSetting& setting) {
    return in_precision(setting.solver.precision, [&](auto real) { return run_as<decltype(real)>(spin, setting); });
}

}  // namespace

WaterRun run_spinning_sphere(const WaterSetting& setting) {
    return run({.viscosity = 0.1, .rate = 0.5, .gravity = 1, .from = 1}, setting);
}

/// Slowly, in thin water under high pressure: a packing of grains would hold it.
WaterRun run_slow_sphere(const WaterSetting& setting) {
    return run({.viscosity = 0.01, .rate = 0.05, .gravity = 10, .from = 1}, setting);
}

}  // namespace natator::bench
