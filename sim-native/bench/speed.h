#pragma once

#include <functional>
#include <string>
#include <vector>

#include "natator/evaluate.h"
#include "result_table.h"

namespace natator::bench {

/// Run time of whole evaluations: settling, neighbours and all.
struct SpeedStudy {
    std::vector<std::string> scenes;  ///< see speed_scene
    std::vector<Scheme> schemes;
    std::vector<Precision> precisions;
    std::vector<int> threads{1};
    int repeats = 3;
    bool quick = false;  ///< a few frames of each scene
};

/// The thesis' creatures in their tank, 4 s each, creature 1 in vacuum, its tank with 8 and 64 times the fluid, and creature 2 in
/// open water.
std::vector<std::string> speed_scene_names();
/// The names of these scenes at each of these settings, "creature-1 2x4"; without settings as they are. Throws InputError for what is
/// no setting.
std::vector<std::string> speed_scenes_at(const std::vector<std::string>& scenes, const std::vector<std::string>& settings);
/// `name`: of speed_scene_names, or of one of them at a setting.
Scene speed_scene(const std::string& name, bool quick);
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
