#include <cmath>

#include "water/drag_law.h"
#include "water/towing.h"
#include "water/water_tank.h"

namespace natator::bench {
namespace {

constexpr double reynolds = 100, drag = 1.355, strouhal = 0.165;  ///< between 1.33 and 1.38, 0.164 and 0.166
constexpr double way = 60, counted_from = 35;                     ///< diameters

/// Of the swings of the lift about its mean, from the first to the last time that it passes it upwards; 0 without any.
double frequency(const std::vector<TowSample>& leg) {
    double mean = 0;
    int count = 0;
    for (const TowSample& sample : leg) {
        if (sample.way < counted_from) continue;
        mean += sample.lift;
        ++count;
    }
    mean /= count;
    // Smoothed over a twentieth of the period that is expected, and counted only where it has been well below the mean
    // since, so that noise makes no swings.
    double smooth = 0, first = 0, last = 0, spread = 0;
    int swings = -1;
    bool below = false;
    for (const TowSample& sample : leg)
        if (sample.way >= counted_from) spread += std::pow(sample.lift - mean, 2) / count;
    for (const TowSample& sample : leg) {
        if (sample.way < counted_from) continue;
        smooth += 0.2 * (sample.lift - mean - smooth);
        if (smooth < -0.3 * std::sqrt(spread)) below = true;
        if (!below || smooth < 0) continue;
        below = false;
        if (++swings == 0) first = sample.time;
        last = sample.time;
    }
    return swings > 0 ? swings / (last - first) : 0;
}

}  // namespace

/// A cylinder across a slab, held and towed through resting water until its wake has become a street of vortices. At resolution
/// 20 it is 10 particles across, and the slab three deep between planes that let the water slip: the flow is plane.
WaterRun run_towed_cylinder(const WaterSetting& setting) {
    const double spacing = water_length / setting.resolution, diameter = 0.5 * water_length, height = 10 * diameter;
    const auto particles = [&](double length) { return static_cast<int>(std::lround(length / spacing)); };
    const Towing towing{.count = {particles(20 * diameter), particles(height), 3},
                        .middle = {6 * diameter, height / 2, 0},
                        .diameter = diameter,
                        .cylinder = true,
                        .speed = 1.5,
                        .gravity = 2,
                        .legs = {{reynolds, way}}};
    TowResult result = tow(towing, setting);
    WaterRun& run = result.run;
    if (run.instability) return run;
    const std::vector<TowSample>& leg = result.legs[0];
    const double faster = 1 + blockage_of_cylinder(drag, result.diameter, height);
    const double drag_there = drag * faster * faster, strouhal_there = strouhal * faster;
    run.figures = {{.value = mean_drag(leg, counted_from),
                    .reference = drag_there,
                    .least = 0.9 * drag_there,
                    .greatest = 1.1 * drag_there},
                   {.value = frequency(leg) * result.diameter / towing.speed,
                    .reference = strouhal_there,
                    .least = 0.95 * strouhal_there,
                    .greatest = 1.05 * strouhal_there}};
    for (const TowSample& sample : leg) run.curve.push_back({sample.time, sample.lift});
    return run;
}

}  // namespace natator::bench
