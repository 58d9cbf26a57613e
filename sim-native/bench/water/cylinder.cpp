#include <cmath>

#include "water/drag_law.h"
#include "water/towing.h"
#include "water/water_tank.h"

namespace natator::bench {
namespace {

constexpr double counted_from = 35;  ///< of the way with vortices, diameters

/// A cylinder across a slab: at resolution 20 it is 10 particles across, and the slab three deep between planes that let
/// the water slip, so that the flow is plane.
Towing across_slab(const WaterSetting& setting, double length, double height, const std::vector<Towing::Leg>& legs) {
    const double diameter = 0.5 * water_length;
    return {.count = {particles_along(length * diameter, setting), particles_along(height * diameter, setting), 3},
            .middle = {length / 3 * diameter, height / 2 * diameter, 0},
            .diameter = diameter,
            .cylinder = true,
            .speed = 1.5,
            .gravity = 1,
            .legs = legs};
}

/// What it is in an unbounded stream, at the speed of the stream that passes it between floor and surface.
WaterFigure drag_figure(double measured, double unbounded, double faster) {
    return figure_within(0.1, measured, unbounded * faster * faster);
}

/// Of the swings of the lift about its mean, from the first to the last time that it passes it upwards; 0 without any.
double frequency(const std::vector<TowSample>& leg) {
    const double mean_lift = mean(leg, &TowSample::lift, counted_from);
    // Smoothed over a twentieth of the period that is expected, and counted only where it has been well below the mean
    // since, so that noise makes no swings.
    double smooth = 0, first = 0, last = 0, spread = 0;
    int count = 0, swings = -1;
    bool below = false;
    for (const TowSample& sample : leg) {
        if (sample.way < counted_from) continue;
        ++count;
        spread += std::pow(sample.lift - mean_lift, 2);
    }
    spread /= count;
    for (const TowSample& sample : leg) {
        if (sample.way < counted_from) continue;
        smooth += 0.2 * (sample.lift - mean_lift - smooth);
        if (smooth < -0.3 * std::sqrt(spread)) below = true;
        if (!below || smooth < 0) continue;
        below = false;
        if (++swings == 0) first = sample.time;
        last = sample.time;
    }
    return swings > 0 ? swings / (last - first) : 0;
}

}  // namespace

/// Towed through resting water without vortices yet. References: Dennis and Chang (1970), whose drag falls as the Reynolds
/// number to the power 0.426 between the two.
WaterRun run_towed_cylinder(const WaterSetting& setting) {
    constexpr double height = 12, drag[2] = {1.522, 2.045};
    const Towing towing = across_slab(setting, 12, height, {{40, 9}, {20, 5}});
    TowResult result = tow(towing, setting);
    WaterRun& run = result.run;
    if (run.instability) return run;
    for (std::size_t k = 0; k < towing.legs.size(); ++k) {
        const double faster = 1 + blockage_of_cylinder(drag[k], result.diameter, height * towing.diameter);
        run.figures.push_back(drag_figure(mean(result.legs[k], &TowSample::drag, 0.6 * towing.legs[k].way),
                                          drag[k] * std::pow(faster, -0.426), faster));
    }
    run.curve = smoothed(result, &TowSample::drag);
    return run;
}

/// The same until the wake has become a street of vortices. References: drag 1.33 to 1.38, Strouhal number 0.164 to 0.166.
WaterRun run_shedding_cylinder(const WaterSetting& setting) {
    constexpr double height = 10, reynolds = 100, drag = 1.355, strouhal = 0.165;
    const Towing towing = across_slab(setting, 20, height, {{reynolds, 60}});
    TowResult result = tow(towing, setting);
    WaterRun& run = result.run;
    if (run.instability) return run;
    const std::vector<TowSample>& leg = result.legs[0];
    const double faster = 1 + blockage_of_cylinder(drag, result.diameter, height * towing.diameter);
    run.figures = {drag_figure(mean(leg, &TowSample::drag, counted_from), drag, faster),
                   figure_within(0.05, frequency(leg) * result.diameter / towing.speed, strouhal * faster)};
    run.curve = smoothed(result, &TowSample::lift);
    return run;
}

}  // namespace natator::bench
