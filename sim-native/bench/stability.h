#pragma once

#include <functional>
#include <string>
#include <vector>

#include "natator/evaluate.h"
#include "result_table.h"
#include "stability_axes.h"

namespace natator::bench {

enum class Verdict {
    ok,
    diverged,  ///< finite but impossible: faster than gravity and muscles make it, through a wall, or collapsed
    unstable,  ///< a value was not finite
};

/// How a run under stress ended.
struct StabilityResult {
    Verdict verdict = Verdict::ok;
    int particle = -1;     ///< the first bad one; -1 = none
    std::string stage;     ///< unstable: stage of the substep; diverged: "speed", "energy", "outside" or "compression"
    double time = 0;       ///< of the first bad value; else the simulated time, s
    double max_speed = 0;  ///< over all frames, length/s
    double max_kinetic_energy = 0;  ///< over all frames, mass length^2/s^2
    int outside = 0;                ///< particles more than their radius beyond a plane at the end
    double compression = 0;         ///< mean of max(rho - 1, 0) of the fluid at the end
};

/// Runs a case for its scene's duration, at least 8 frames. Speeds and energies are compared with PhysicalBounds after
/// each frame; places with the planes and the fluid's mean density with 2 at the end: particles may start elsewhere.
StabilityResult run_stability(const StabilityCase& subject, Precision precision);

/// One run of a sweep: an axis at a value, or two axes.
struct StabilityPoint {
    std::string axis;
    double value = 0;
    std::string second_axis;  ///< empty in a sweep of one axis
    double second_value = 0;
};

/// All points of the axes and maps asked for by name ("dt", "dt:iterations"); without names all of them.
std::vector<StabilityPoint> stability_points(const std::vector<std::string>& names, bool quick);

struct StabilityStudy {
    std::vector<Scheme> schemes;
    std::vector<Precision> precisions;
    std::vector<std::string> axes;  ///< as for stability_points
    bool quick = false;             ///< ends of the axes only, a fifth of the duration
    bool modified_pressure = false; ///< see SolverParameters; rows do not tell
};

/// Columns scheme, precision, axis, value, second_axis, second_value (these are the key), status, particle, stage,
/// time, max_speed, max_kinetic_energy, outside, compression; see StabilityResult.
Row stability_columns();
inline constexpr std::size_t stability_key_columns = 6;

/// Runs what `table` does not hold yet. `report` gets a line per run.
void run_stability_study(const StabilityStudy& study, ResultTable& table,
                         const std::function<void(const std::string&)>& report);

/// Points at which scheme `flex` is ok and `conserving` is not, as "precision axis value [axis value]: status".
std::vector<std::string> where_only_flex_is_ok(const std::vector<Row>& rows);

}  // namespace natator::bench
