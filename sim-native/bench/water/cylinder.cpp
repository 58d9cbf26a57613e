#include <cmath>

#include "water/drag_law.h"
#include "water/towing.h"
#include "water/water_tank.h"

namespace natator::bench {
namespace {

constexpr double counted_from = 35;  ///< of the way with vortices, diameters

/// A cylinder across a slab: at resolution 20 it is 10 particles across, and the slab three deep between planes that
/// let the water slip, so that the flow is plane.
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

}  // namespace

/// Towed through resting water without vortices yet. References: Dennis and Chang (1970), whose drag falls as the
/// Reynolds number to the power 0.426 between the two. In a box half as long its ends raise the drag by a tenth, in one
/// longer by a half it is the same within 1 %.
WaterRun run_towed_cylinder(const WaterSetting& setting) {
    constexpr double length = 24, height = 12, drag[2] = {1.522, 2.045};
    const Towing towing = across_slab(setting, length, height, {{40, 9}, {20, 5}});
    TowResult result = tow(towing, setting);
    WaterRun& run = result.run;
    if (run.instability) return run;
    for (std::size_t k = 0; k < result.legs.size(); ++k) {
        const double faster = 1 + blockage_of_cylinder(drag[k], result.diameter, height * towing.diameter);
        run.figures.push_back(drag_figure(mean(result.legs[k], &TowSample::drag, 0.6 * towing.legs[k].way),
                                          drag[k] * std::pow(faster, -0.426), faster));
    }
    run.curve = smoothed(result, &TowSample::drag);
    return run;
}

namespace {

/// Until the wake has become a street of vortices, `height` diameters between floor and surface. References: drag 1.33
/// to 1.38, Strouhal number 0.164 to 0.166.
WaterRun shed(const WaterSetting& setting, double height) {
    constexpr double reynolds = 100, drag = 1.355, strouhal = 0.165;
    Towing towing = across_slab(setting, 20, height, {{reynolds, 60}});
    towing.sway = 0.2;
    TowResult result = tow(towing, setting);
    WaterRun& run = result.run;
    if (run.instability || result.legs.empty()) return run;
    const double faster = 1 + blockage_of_cylinder(drag, result.diameter, height * towing.diameter);
    run.figures = {
        drag_figure(mean(result.legs[0], &TowSample::drag, counted_from), drag, faster),
        figure_within(0.05, lift_frequency(result, counted_from) * result.diameter / towing.speed, strouhal * faster)};
    run.curve = calm_lift(result);
    return run;
}

}  // namespace

WaterRun run_shedding_cylinder(const WaterSetting& setting) {
    return shed(setting, 10);
}

WaterRun run_tall_cylinder(const WaterSetting& setting) {
    return shed(setting, 20);
}

}  // namespace natator::bench
