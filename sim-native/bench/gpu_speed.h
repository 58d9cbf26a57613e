#pragma once

#include <functional>
#include <string>
#include <vector>

#include "natator/evaluate.h"
#include "result_table.h"
#include "speed.h"

namespace natator::bench {

/// Run time of batches of evaluations on a GPU: as many different gaits in one scene.
struct GpuSpeedStudy {
    std::vector<SpeedScene> scenes;
    std::vector<Scheme> schemes;
    std::vector<Precision> precisions;
    std::vector<int> batches{1, 150};  ///< evaluations per launch
    int device = 0;
    int repeats = 3;
    bool quick = false;          ///< a few frames of each scene
    bool whole_gpu = false;      ///< for each evaluation, however small; the device's name says so
    bool without_lists = false;  ///< of the neighbours of water; likewise
};

/// Columns scene, scheme, precision, evaluations, device (these are the key); particles, fluid_particles, substeps and
/// iterations of each; repeats; kernel_seconds: all frames on the device; settling_seconds: the start, on the device,
/// in the first repeat, which keeps it; whole_seconds: from the gaits to the evaluations with their hashes; the first
/// and the last are the least of the repeats; million_particle_iterations_per_second: evaluations x (fluid particles,
/// or all without fluid) x substeps x iterations over kernel_seconds; hash: of the evaluations' hashes.
Row gpu_speed_columns();
/// The key of gpu_speed_columns, then stage, seconds, share: of a run apart, as measuring costs time.
Row gpu_speed_profile_columns();
inline constexpr std::size_t gpu_speed_key_columns = 5;

/// Runs what `table` does not hold yet. `report` gets a line per row, and one per scene that the GPU cannot do. Throws
/// std::runtime_error when two runs of one row differ in a bit, NoDevice without that GPU.
void run_gpu_speed_study(const GpuSpeedStudy& study, ResultTable& table, ResultTable& profile,
                         const std::function<void(const std::string&)>& report);

}  // namespace natator::bench
