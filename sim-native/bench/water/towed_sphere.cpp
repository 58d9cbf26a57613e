#include <cmath>

#include "water/drag_law.h"
#include "water/towing.h"
#include "water/water_tank.h"

namespace natator::bench {

/// A sphere that is held and towed through resting water at one speed, ever more viscous: the water's own drag, without
/// what a fall would depend on, its weight and buoyancy. At resolution 20 it is 8 particles across.
WaterRun run_towed_sphere(const WaterSetting& setting) {
    const double diameter = 0.4 * water_length, width = 1.6 * water_length;
    const int across = particles_along(width, setting);
    const Towing towing{.count = {particles_along(6 * diameter, setting), across, across},
                        .middle = {2.5 * diameter, width / 2, width / 2},
                        .diameter = diameter,
                        .speed = 1,
                        .gravity = 1,
                        .legs = {{100, 5}, {50, 3}, {20, 2.5}, {10, 1.5}}};
    TowResult result = tow(towing, setting);
    WaterRun& run = result.run;
    if (run.instability) return run;
    for (std::size_t k = 0; k < result.legs.size(); ++k) {
        const auto [reynolds, way] = towing.legs[k];
        const double between = blockage_of_sphere(drag_of_sphere(reynolds), result.diameter, width * width);
        const double reference = drag_of_sphere(reynolds * (1 + between)) * std::pow(1 + between, 2);
        run.figures.push_back(figure_within(0.1, mean(result.legs[k], &TowSample::drag, way / 2), reference));
    }
    run.curve = smoothed(result, &TowSample::drag);
    return run;
}

}  // namespace natator::bench
