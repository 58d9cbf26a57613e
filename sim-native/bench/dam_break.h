#pragma once

#include <optional>

#include "front_error.h"
#include "natator/model.h"
#include "path_run.h"

namespace natator::bench {

/// A column of fluid that stands between a wall and a gate until the gate vanishes.
struct DamBreak {
    int height_over_base = 2;  ///< n^2
    int width = 32;            ///< particles along the base
    bool ideal = true;         ///< no viscosity, damping or friction; else the thesis' parameters
};

/// The column between its walls; the last plane is the gate.
Model dam_break_model(const DamBreak& column, Scheme scheme);

struct DamBreakRun {
    int particles = 0;
    double start_height = 0;                 ///< of the column at rest over its base
    FrontCurve front;                        ///< a point per frame
    double seconds = 0;                      ///< wall time from the gate's opening on
    std::optional<Instability> instability;  ///< then the rest is void
};

/// Lets the column come to rest behind the gate for 1 s, then follows the front until `last_time` (in T).
DamBreakRun run_dam_break(const DamBreak& column, const Setting& setting, double last_time);

}  // namespace natator::bench
