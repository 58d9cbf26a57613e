#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "natator/evaluate.h"
#include "result_table.h"
#include "run/laws.h"
#include "solver/gpu_solver.h"
#include "stability_axes.h"

namespace natator::bench {

/// How a run under stress ended.
struct StabilityResult {
    std::optional<Instability> instability;  ///< of a value or a law, as evaluations have it; none: ok
    double time = 0;                         ///< simulated, s
    LawMargins margins;                      ///< what the run has used until then of what laws allow
};

/// Runs a case for its scene's duration, at least 8 frames, settling included, and judges it as evaluations are judged:
/// by LawWatch, with the limits of the start that the case has, after settling, after each frame, and at the end by the
/// fluid's compression. Starts that are not settled, crowded ones too, are judged in the same way from their first
/// moment on. One that breaks a law by itself, water behind a wall (StabilityCase::judged_from), is judged from half of
/// the run on: by then it must keep all laws, with the energy that it began with. That no value is infinite is watched
/// from the start. `gpu`: where to compute instead of on the CPU; throws as GpuSolver. Throws InputError where the
/// scene has what the scheme cannot do.
StabilityResult run_stability(const StabilityCase& subject, Precision precision,
                              const std::optional<GpuSolverOptions>& gpu = {});

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
    std::vector<std::string> axes;                  ///< as for stability_points
    bool quick = false;                             ///< ends of the axes only, a fifth of the duration
    std::vector<std::string> scenes{"small-tank"};  ///< of stability_scenes
    double duration = 1;                            ///< s; at least 8 frames are run
    std::optional<GpuSolverOptions> gpu{};          ///< where to compute instead of on the CPU
};

/// Columns scheme, precision, backend, scene, axis, value, second_axis, second_value (these are the key), status ("ok"
/// or "unstable"), law, particle, stage, time (of the breach, else simulated, s), then what the run has used of what
/// laws allow: particle_energy, energy, depth, reach, compression, and the largest of them; see Instability and
/// LawMargins.
Row stability_columns();
inline constexpr std::size_t stability_key_columns = 8;

/// Runs what `table` does not hold yet. `report` gets a line per run, and for each that a scene or a backend cannot do
/// why.
void run_stability_study(const StabilityStudy& study, ResultTable& table,
                         const std::function<void(const std::string&)>& report);

/// Points at which scheme `flex` is ok and `conserving` is not, as "precision backend scene axis value [axis value]:
/// law".
std::vector<std::string> where_only_flex_is_ok(const std::vector<Row>& rows);

}  // namespace natator::bench
