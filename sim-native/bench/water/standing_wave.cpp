#include <cmath>
#include <limits>
#include <numbers>

#include "water/water_tank.h"

namespace natator::bench {
namespace {

constexpr double wave_number = std::numbers::pi / water_length;  ///< k: half a wave fits between the walls
constexpr double amplitude = 0.1 * water_length;                 ///< two spacings at 20 particles
constexpr int periods = 5;                                       ///< how long it is followed
constexpr int width = 8;                                         ///< particles across the plane of the flow

/// Sets the velocities of the linear standing wave as its surface passes through the level (Lamb, Hydrodynamics, 228):
/// the surface is then a cos(kx) sin(omega t).
template <class Real>
void kick(double depth, double omega, State<Real>& state) {
    const double scale = amplitude * omega / std::sinh(wave_number * depth);
    for (std::size_t i = 0; i < state.position.size(); ++i) {
        const double x = wave_number * static_cast<double>(state.position[i].x());
        const double y = wave_number * static_cast<double>(state.position[i].y());
        state.velocity[i] = Eigen::Vector3d(-scale * std::sin(x) * std::cosh(y), scale * std::cos(x) * std::sinh(y), 0)
                                .template cast<Real>();
    }
}

/// Time at which the curve passes through 0 between two samples.
double crossing(const WaterSample& before, const WaterSample& after) {
    return before.time + (after.time - before.time) * before.value / (before.value - after.value);
}

struct Oscillation {
    double period = std::numeric_limits<double>::quiet_NaN();  ///< s; NaN if it does not swing to and fro
    double decay = std::numeric_limits<double>::quiet_NaN();   ///< 1/s, of the height of its peaks
};

/// The period is that between the first and the last passage through 0, the decay that of the peaks between them by
/// least squares.
Oscillation oscillation_of(const std::vector<WaterSample>& curve) {
    std::vector<double> passages{0};
    std::vector<WaterSample> peaks;
    WaterSample peak;
    for (std::size_t i = 1; i < curve.size(); ++i) {
        if (std::abs(curve[i].value) > std::abs(peak.value)) peak = curve[i];
        if (i > 1 && (curve[i - 1].value > 0) != (curve[i].value > 0)) {
            passages.push_back(crossing(curve[i - 1], curve[i]));
            peaks.push_back(peak);
            peak = {};
        }
    }
    if (peaks.size() < 2) return {};
    double t = 0, log = 0, tt = 0, tlog = 0;
    for (const WaterSample& one : peaks) {
        const double height = std::log(std::abs(one.value));
        t += one.time, log += height, tt += one.time * one.time, tlog += one.time * height;
    }
    const auto n = static_cast<double>(peaks.size());
    return {.period = 2 * (passages.back() - passages.front()) / n, .decay = -(n * tlog - t * log) / (n * tt - t * t)};
}

template <class Real>
WaterRun run_as(const WaterSetting& setting) {
    const int layers = static_cast<int>(std::lround(0.6 * setting.resolution));
    WaterTank<Real> tank({setting.resolution, layers, width}, setting);
    const double depth = tank.depth();
    const double period = tank.sloshing_period();
    kick(depth, 2 * std::numbers::pi / period, tank.state());

    // The mean of cos(kx) over the water is the elevation of the mode over twice the depth.
    const auto elevation = [&] {
        return 2 * depth * tank.mean([](const auto& x, const auto&) { return std::cos(wave_number * x.x()); });
    };
    WaterRun run = tank.follow(periods * period, [&, level = elevation()] { return elevation() - level; });
    if (run.instability) return run;

    const Oscillation found = oscillation_of(run.curve);
    run.figures = {figure_within(0.03, found.period, period),
                   {.value = found.decay, .reference = 0, .least = -0.01, .greatest = 0.05}};
    return run;
}

}  // namespace

WaterRun run_standing_wave(const WaterSetting& setting) {
    return in_precision(setting.solver.precision, [&](auto real) { return run_as<decltype(real)>(setting); });
}

}  // namespace natator::bench
