#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "natator/evaluate.h"
#include "path_run.h"
#include "result_table.h"

namespace natator::bench {

/// How much water a GPU computes in a second: over the size of a scene, and over how many are computed at once.
struct ThroughputStudy {
    std::vector<Scheme> schemes;
    std::vector<Precision> precisions;
    std::vector<int> particles;  ///< of fluid, about; see throughput_scene
    std::vector<int> batches;    ///< evaluations per launch
    int device = 0;
    int repeats = 3;
    bool quick = false;                                        ///< a few frames of each
    bool whole_gpu = false;                                    ///< for each evaluation, however small
    bool without_lists = false;                                ///< of the neighbours of water
    std::vector<std::optional<Steps>> settings{std::nullopt};  ///< instead of the scene's own
};

/// About factors of 2 from 1000 to 1 000 000, and the number of the thesis' tank.
std::vector<int> throughput_particles();
std::vector<int> throughput_batches();

/// Bounds of what throughput_scene takes: a smaller tank would be narrower than its swimmer's place, a larger one have
/// more particles than limits::particles.
inline constexpr int min_throughput_particles = 1000, max_throughput_particles = 15'000'000;
/// Fluid particles of a batch's scenes together, beyond which only batches of one are computed.
inline constexpr int max_particles_of_batch = 2'500'000;

/// Creature 1 in a tank in the proportions of the thesis', with so many fluid particles to within half a layer across.
/// They begin at the rest distance: at the thesis' 0.09 the water is 1.37 times as dense as at rest, shallow water
/// comes apart before time 0, and deep water, as in `bench speed --scene fluid-x64`, spends the time that is measured
/// on it. The swimmer is where the thesis has it, but no higher than the surface.
Scene throughput_scene(int particles);

/// Frames of an evaluation, so that a batch takes a GPU from a tenth of a second to some seconds: 4 to 240.
int throughput_frames(Scheme scheme, int particles, int batch);

/// How often a substep goes through the neighbours of all particles, without the search. Scheme flex: twice an
/// iteration (density, constraint), once for viscosity. Scheme conserving: twice a pass (impulses, push), and moments,
/// gradients, the push of the divergence pass, the end of the passes; viscosity where there is any. Passes that part
/// overlaps, 7 times in a substep of a scene that has any, are left out.
int pair_passes(const Model& model);

/// Columns scheme, precision, fluid_particles, evaluations, device, path (block or whole GPU), particles of one scene,
/// substeps of a frame, iterations, modified_pressure (yes, no, empty in scheme flex; these are the key); frames,
/// repeats; neighbours: mean of the fluid particles after one frame, with solids and ghosts where they are in the
/// lists; pair_passes: of a substep; kernel_seconds: all frames on the device, the least of the repeats; ms_per_frame:
/// of all evaluations together; million_particle_iterations_per_second: evaluations x fluid_particles x frames x
/// substeps x iterations over kernel_seconds; million_pairs_per_second: evaluations x fluid_particles x neighbours x
/// frames x substeps x pair_passes over kernel_seconds; at_a_time: evaluations that are on the device together;
/// bytes_per_particle: device memory over at_a_time x particles; hash: of the evaluations' hashes.
Row throughput_columns();
inline constexpr std::size_t throughput_key_columns = 10;

/// Runs what `table` does not hold yet. `report` gets a line per row, and one for each that the device can't do: one
/// that lacks the memory, and one that becomes unstable. Throws std::runtime_error when two runs of one row differ in a
/// bit, NoDevice without that GPU.
void run_throughput_study(const ThroughputStudy& study, ResultTable& table,
                          const std::function<void(const std::string&)>& report);

}  // namespace natator::bench
