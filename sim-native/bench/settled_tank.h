#pragma once

#include <optional>

#include "path_run.h"

namespace natator::bench {

/// How well the fluid of the thesis' tank keeps its density at rest, and at what cost.
struct SettledTankRun {
    int particles = 0;
    double frame_seconds = 0;       ///< wall time of a frame, median
    double density_error_mean = 0;  ///< of max(rho - 1, 0) over fluid and frames; rho in units of rest density, in the
    double density_error_max = 0;   ///< scheme's own kernel; largest of all particles and frames
    double density_deviation = 0;   ///< mean of |rho - 1| deeper than two interaction radii below the surface
    std::optional<Instability> instability;  ///< then the rest is void
};

/// Runs the scene thesis/tank for `rest` s and measures over the `window` s after them.
SettledTankRun run_settled_tank(const Setting& setting, double rest, double window);

}  // namespace natator::bench
