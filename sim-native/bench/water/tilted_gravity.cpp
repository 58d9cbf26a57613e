#include <cmath>
#include <numbers>

#include "water/water_tank.h"

namespace natator::bench {
namespace {

constexpr double radian = std::numbers::pi / 180;
constexpr double tilt = 1;  ///< degrees
constexpr int width = 8;    ///< particles across the plane of the flow
constexpr int periods = 6;  ///< of sloshing, with gravity tilted and again with it upright
constexpr int counted = 4;  ///< the last of these are averaged over, so that sloshing cancels

template <class Real>
WaterRun run_as(const WaterSetting& setting) {
    const int layers = static_cast<int>(std::lround(0.4 * setting.resolution));
    WaterTank<Real> tank({setting.resolution, layers, width}, setting);
    const double depth = tank.depth();
    const Eigen::Vector3d upright = tank.model().parameters.gravity;
    const Eigen::Vector3d tilted = Eigen::AngleAxisd(tilt * radian, Eigen::Vector3d::UnitZ()) * upright;

    // A plane surface of slope s moves the centre of mass by s L^2 / (12 h).
    const auto mean_x = [&] { return tank.mean([](const auto& x, const auto&) { return x.x(); }); };
    const auto slope = [&, level = mean_x()] {
        const double moved = mean_x() - level;
        return std::atan(moved * 12 * depth / (water_length * water_length)) / radian;
    };
    const long frames_per_period = std::lround(tank.sloshing_period() / tank.model().time_step);

    std::vector<WaterSample> curve{{0, 0}};
    const auto mean_slope_under = [&](const Eigen::Vector3d& gravity) {
        tank.set_gravity(gravity);
        double sum = 0;
        for (long frame = 0; frame < periods * frames_per_period && tank.frame(); ++frame) {
            curve.push_back({curve.back().time + tank.model().time_step, slope()});
            if (frame >= (periods - counted) * frames_per_period) sum += curve.back().value;
        }
        return sum / static_cast<double>(counted * frames_per_period);
    };
    const double under = mean_slope_under(tilted);
    const double afterwards = mean_slope_under(upright);
    WaterRun run = tank.run();
    if (run.instability) return run;
    run.figures = {{.value = under, .reference = tilt, .least = tilt - 0.05, .greatest = tilt + 0.05},
                   {.value = afterwards, .reference = 0, .least = -0.05, .greatest = 0.05}};
    run.curve = curve;
    return run;
}

}  // namespace

WaterRun run_tilted_gravity(const WaterSetting& setting) {
    return in_precision(setting.solver.precision, [&](auto real) { return run_as<decltype(real)>(setting); });
}

}  // namespace natator::bench
