#include <cmath>

#include "water/water_tank.h"

namespace natator::bench {
namespace {

constexpr int width = 6;        ///< particles along x and z
constexpr double followed = 4;  ///< s
constexpr double counted = 1;   ///< s, at the end

template <class Real>
WaterRun run_as(const WaterSetting& setting) {
    WaterTank<Real> tank({width, setting.resolution, width}, setting);
    WaterRun run = tank.follow(followed, [&] { return tank.depth(); });
    if (run.instability) return run;
    const double frame = tank.model().time_step;
    const auto frames = static_cast<std::size_t>(std::lround(counted / frame));
    double squares = 0;
    for (std::size_t k = run.curve.size() - frames; k < run.curve.size(); ++k)
        squares += std::pow((run.curve[k].value - run.curve[k - 1].value) / frame, 2);
    run.figures = {{.value = std::sqrt(squares / static_cast<double>(frames)), .reference = 0, .greatest = 0.02}};
    return run;
}

}  // namespace

/// A narrow column of water at rest, as deep as the other cases are long, without viscosity: does it stay so, or bob up
/// and down as a whole? Its speed is that of twice its mean height.
WaterRun run_still_water(const WaterSetting& setting) {
    return in_precision(setting.solver.precision, [&](auto real) { return run_as<decltype(real)>(setting); });
}

}  // namespace natator::bench
