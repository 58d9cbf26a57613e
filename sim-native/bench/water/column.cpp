#include <algorithm>
#include <cmath>

#include "water/water_tank.h"

namespace natator::bench {
namespace {

constexpr int width = 10;       ///< particles along x and z
constexpr double followed = 2;  ///< s
// Where pressure is measured: below that part of the depth, and so many particle distances from floor and walls.
constexpr double lower = 0.6, apart = 2.5;

/// Sums over those particles.
struct Pressures {
    double measured = 0, hydrostatic = 0;  ///< mass/(length s^2)
};

template <class Real>
Pressures pressures_in(const WaterTank<Real>& tank) {
    const SolverParameters& p = tank.model().parameters;
    const double weight = p.gravity.norm() / std::pow(p.fluid_rest_distance, 3);  // of a volume: particles of mass 1
    const double depth = tank.depth();
    const std::vector<Real> pressures = tank.pressures();
    Pressures sums;
    for (std::size_t i = 0; i < pressures.size(); ++i) {
        const Eigen::Vector3d x = tank.state().position[i].template cast<double>() / p.fluid_rest_distance;
        const double y = x.y() * p.fluid_rest_distance;
        if (y > lower * depth || x.minCoeff() < apart || std::max(x.x(), x.z()) > width - apart) continue;
        sums.measured += static_cast<double>(pressures[i]);
        sums.hydrostatic += weight * (depth - y);
    }
    return sums;
}

template <class Real>
WaterRun run_as(const WaterSetting& setting) {
    WaterTank<Real> tank({width, setting.resolution, width}, setting);
    double measured = 0, hydrostatic = 0, depth = 0, square = 0;
    std::vector<WaterSample> curve;
    const long frames = std::lround(followed / tank.model().time_step);
    for (long frame = 1; frame <= frames && tank.frame(); ++frame) {
        const Pressures sums = pressures_in(tank);
        measured += sums.measured;
        hydrostatic += sums.hydrostatic;
        depth += tank.depth() / static_cast<double>(frames);
        square += tank.mean([](const auto&, const auto& v) { return v.squaredNorm(); }) / static_cast<double>(frames);
        curve.push_back({static_cast<double>(frame) * tank.model().time_step, sums.measured / sums.hydrostatic});
    }
    WaterRun run = tank.run();
    if (run.instability) return run;
    run.figures = {figure_within(0.05, measured / hydrostatic, 1),
                   figure_within(0.02, depth, water_length),
                   {.value = std::sqrt(square), .reference = 0}};
    run.curve = curve;
    return run;
}

}  // namespace

/// Water at rest, as deep as the other cases are long: its pressure, how far it gives way under its weight, and how
/// much its particles still move.
WaterRun run_column(const WaterSetting& setting) {
    return in_precision(setting.solver.precision, [&](auto real) { return run_as<decltype(real)>(setting); });
}

}  // namespace natator::bench
