#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "natator/evaluate.h"
#include "path_run.h"
#include "result_table.h"

namespace natator::bench {

/// A scene whose run time is measured.
struct SpeedScene {
    std::string name;              ///< one of speed_scene_names
    std::optional<Steps> steps{};  ///< instead of the scene's own

    std::string text() const;  ///< what rows call it: "creature-1", with steps "creature-1 2x4"
};

/// Run time of whole evaluations: settling, neighbours and all.
struct SpeedStudy {
    std::vector<SpeedScene> scenes;
    std::vector<Scheme> schemes;
    std::vector<Precision> precisions;
    std::vector<int> threads{1};
    int repeats = 3;
    bool quick = false;  ///< a few frames of each scene
};

/// The thesis' creatures in their tank, 4 s each, creature 1 in vacuum, its tank with 8 and 64 times the fluid, and
/// creature 2 in open water.
std::vector<std::string> speed_scene_names();
/// Each of these scenes at each of these settings, such as "2x4"; without settings at its own. Throws InputError for
/// what is no setting.
std::vector<SpeedScene> speed_scenes_at(const std::vector<std::string>& names,
                                        const std::vector<std::string>& settings);
/// The scene itself, or a few frames of it if `quick`. Throws InputError for an unknown name.
Scene make_speed_scene(const SpeedScene& named, bool quick);
/// What all frames of a scene are, without settling: columns particles, fluid_particles, substeps, iterations.
struct SpeedWork {
    Row columns;
    double particle_iterations;  ///< (fluid particles, or all without fluid) x substeps x iterations
};
SpeedWork speed_work(const Scene& scene);
/// The thesis' gait where it found one, else all muscles in a travelling wave.
Gait speed_gait(const Scene& scene);

/// Columns scene, scheme, precision, instruction_set, threads, machine (these are the key); particles, fluid_particles,
/// substeps (of all frames, without settling), iterations; repeats; seconds_least, seconds_median;
/// million_particle_iterations_per_second: (fluid particles, or all without fluid) x substeps x iterations over
/// seconds_least; peak_mb; hash.
Row speed_columns();
/// The key of speed_columns, then stage, calls, seconds, share (of the time in all stages): of the fastest repeat.
Row speed_profile_columns();
inline constexpr std::size_t speed_key_columns = 6;

/// Runs what `table` does not hold yet; `profile` gets a row per stage of each. The settings of a scene take
/// turns, so that a slow spell of the machine hits all alike. `report` gets a line per row. Throws
/// std::runtime_error when two runs of a scene, scheme and precision differ in a bit.
void run_speed_study(const SpeedStudy& study, ResultTable& table, ResultTable& profile,
                     const std::function<void(const std::string&)>& report);

}  // namespace natator::bench
