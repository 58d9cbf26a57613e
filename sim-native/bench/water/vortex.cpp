#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "water/water_tank.h"

namespace natator::bench {
namespace {

constexpr double speed = 0.5;  ///< U, length/s
constexpr int turnovers = 4;   ///< how long it is followed, in L / U
constexpr int layers = 8;
constexpr double faint = 0.05;     ///< amplitudes below this say nothing of the decay
constexpr double unlimited = 1e6;  ///< Reynolds number of a flow that does not decay

/// One cell of a Taylor-Green flow between free-slip walls: u = U sin(kx) cos(kz), w = -U cos(kx) sin(kz), k = pi / L.
Eigen::Vector3d flow_at(const Eigen::Vector3d& x) {
    constexpr double k = std::numbers::pi / water_length;
    return speed *
           Eigen::Vector3d(std::sin(k * x.x()) * std::cos(k * x.z()), 0, -std::cos(k * x.x()) * std::sin(k * x.z()));
}

/// Part of the flow that is left, by projection on it.
template <class Real>
double amplitude(const WaterTank<Real>& tank) {
    return tank.mean([](const auto& x, const auto& v) { return flow_at(x).dot(v); }) /
           tank.mean([](const auto& x, const auto&) { return flow_at(x).squaredNorm(); });
}

/// Of a particle in the mean, times 2 over its mass: all have the same. length^2/s^2.
struct Energy {
    double kinetic = 0;
    double whole = 0;  ///< kinetic and potential
};

template <class Real>
Energy energy(const WaterTank<Real>& tank) {
    const Eigen::Vector3d gravity = tank.model().parameters.gravity;
    const double kinetic = tank.mean([](const auto&, const auto& v) { return v.squaredNorm(); });
    return {kinetic, kinetic - 2 * tank.mean([&](const auto& x, const auto&) { return gravity.dot(x); })};
}

/// Rate of ln(amplitude), 1/s, by least squares through the start, while there is enough of the flow left.
double decay_rate(const std::vector<WaterSample>& curve) {
    double product = 0, square = 0;
    for (const WaterSample& sample : curve) {
        if (sample.value < faint) break;
        product -= sample.time * std::log(sample.value);
        square += sample.time * sample.time;
    }
    return product / square;
}

constexpr double turnover = water_length / speed;  ///< s

/// Sets the water of a tank that is at rest turning.
template <class Real>
void turn(State<Real>& state) {
    for (std::size_t i = 0; i < state.position.size(); ++i)
        state.velocity[i] = flow_at(state.position[i].template cast<double>()).template cast<Real>();
}

/// From the rate of the decay, amplitude ~ exp(-2 nu k^2 t), length^2/s.
double viscosity_from(double decay_rate) {
    constexpr double k = std::numbers::pi / water_length;
    return decay_rate / (2 * k * k);
}

/// Set viscosity and numerical viscosity together must be what the vortex decays by. The numerical one is that of the
/// same run without any set; half a turnover is long enough for both.
template <class Real>
WaterRun run_viscous_as(const WaterSetting& setting) {
    constexpr double viscosity = 0.02;
    double numerical = 0;
    for (const double set : {0.0, viscosity}) {
        WaterTank<Real> tank({setting.resolution, layers, setting.resolution}, setting);
        turn(tank.state());
        if (!tank.set_kinematic_viscosity(set)) return tank.run();
        WaterRun run = tank.follow(turnover / 2, [&] { return amplitude(tank); });
        if (run.instability) return run;
        const double found = viscosity_from(decay_rate(run.curve));
        if (set == 0) {
            numerical = found;
            continue;
        }
        const double both = viscosity + numerical;
        run.figures = {figure_within(0.05, found, both)};
        return run;
    }
    throw std::logic_error("no run with viscosity");
}

/// Water that has rested packs closer once it turns, and what it loses of its height moves it. `stirred`: it has turned
/// once before, and is set turning anew.
template <class Real>
WaterRun run_as(const WaterSetting& setting, bool stirred) {
    WaterTank<Real> tank({setting.resolution, layers, setting.resolution}, setting);
    turn(tank.state());
    if (stirred) {
        WaterRun stirring = tank.follow(turnover, [&] { return amplitude(tank); });
        if (stirring.instability) return stirring;
        turn(tank.state());
    }
    const long frames_per_turnover = std::lround(turnover / tank.model().time_step);
    const Energy first = energy(tank);
    Energy most = first;
    WaterRun run = tank.follow(static_cast<double>(turnovers * frames_per_turnover) * tank.model().time_step, [&] {
        const Energy now = energy(tank);
        most = {std::max(most.kinetic, now.kinetic), std::max(most.whole, now.whole)};
        return amplitude(tank);
    });
    if (run.instability) return run;

    const bool fine = setting.resolution >= 40;
    const double viscosity = viscosity_from(decay_rate(run.curve));
    const double reynolds = viscosity > 0 ? std::min(speed * water_length / viscosity, unlimited) : unlimited;
    run.figures = {
        {.value = run.curve[frames_per_turnover].value, .reference = 1, .least = fine ? 0.98 : 0.95},
        {.value = reynolds, .reference = std::numeric_limits<double>::infinity(), .least = fine ? 1100.0 : 600.0},
        {.value = (most.kinetic - first.kinetic) / first.kinetic, .reference = 0, .greatest = 0.001},
        {.value = (most.whole - first.whole) / first.kinetic, .reference = 0, .greatest = 0.001}};
    return run;
}

}  // namespace

WaterRun run_vortex(const WaterSetting& setting) {
    return in_precision(setting.solver.precision, [&](auto real) { return run_as<decltype(real)>(setting, false); });
}

WaterRun run_stirred_vortex(const WaterSetting& setting) {
    return in_precision(setting.solver.precision, [&](auto real) { return run_as<decltype(real)>(setting, true); });
}

WaterRun run_viscous_vortex(const WaterSetting& setting) {
    return in_precision(setting.solver.precision, [&](auto real) { return run_viscous_as<decltype(real)>(setting); });
}

}  // namespace natator::bench
