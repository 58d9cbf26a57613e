#pragma once

#include <algorithm>

#include "fetch.h"
#include "kernels.cuh"
#include "rows.h"
#include "scan.h"
#include "solver/step.h"
#include "stage_clock.h"

namespace natator::cuda {

inline int blocks_for(int count, int threads_of_block) {
    return (count + threads_of_block - 1) / threads_of_block;
}

/// What the stages of States side by side on the grid are launched with.
template <class Real>
struct GridLaunch {
    ModelView<Real> model;
    Slots<Real> slots;
    int states;  ///< side by side
    void* scan_room;
    cudaStream_t stream;
    Trace<Real> trace;            ///< null where nobody looks
    StageClock* clock = nullptr;  ///< likewise
    bool keeps_forces = false;    ///< sums the impulses of the water on solids

    /// A grid with so many blocks for each State.
    dim3 grid(int blocks) const { return {static_cast<unsigned>(blocks), static_cast<unsigned>(states)}; }

    /// Threads of a block, at most `block`, where so many are needed for a State: few where that is all, so that every
    /// multiprocessor gets a block.
    int block_for(int threads, int block) const {
        constexpr int few = 64, filling = 32768;
        return threads * states < filling ? std::min(few, block) : block;
    }

    /// Calls work(model, slots, s, more...) for the slots s below `count` of each State, by `lanes` threads each.
    template <auto work, int lanes = 1, int max_threads = grid_threads, int min_blocks = 0, class... More>
    void each_slot(int count, More... more) const {
        const int threads = count * lanes, block = block_for(threads, max_threads);
        if (count > 0)
            for_each_slot<work, Of::running, lanes, max_threads, min_blocks>
                <<<grid(blocks_for(threads, block)), block, 0, stream>>>(model, slots, count, more...);
    }
    template <auto work, int min_blocks = 0>
    void each_particle() const {
        each_slot<work, 1, grid_threads, min_blocks>(model.particles);
    }
    /// The same in States that have some density far above rest, by blocks that fill a GPU once or twice, however many
    /// slots there are.
    template <auto work, int lanes>
    void each_crowded_slot(int count) const {
        constexpr int filling = 2048;
        const int blocks = std::min(blocks_for(count * lanes, grid_threads), blocks_for(filling, states));
        if (count > 0)
            for_each_crowded_slot<work, Of::running, lanes, grid_threads>
                <<<grid(blocks), grid_threads, 0, stream>>>(model, slots, count);
    }
    /// Calls work(model, slots, more...) by all threads of the blocks for each State.
    template <auto work, int block = grid_threads, int min_blocks = 0, class... More>
    void each_state(int blocks, More... more) const {
        for_each_state<work, Of::running, block, min_blocks><<<grid(blocks), block, 0, stream>>>(model, slots, more...);
    }
    /// Has a block so many bytes on its chip?
    static bool has_room_on_chip(std::size_t bytes) {
        return bytes <= static_cast<std::size_t>(device_attribute(cudaDevAttrMaxSharedMemoryPerBlockOptin));
    }
    /// Lets a kernel have as many bytes on a block's chip as there are. The limit belongs to the kernel, for all Models
    /// and threads.
    template <class Kernel>
    static void open_chip(const Kernel& kernel) {
        check(cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize,
                                   device_attribute(cudaDevAttrMaxSharedMemoryPerBlockOptin)),
              "shared memory");
    }
    /// The same by one block for each State, with so many bytes on its chip.
    template <auto work, int block, class... More>
    void each_state_on_chip(unsigned bytes, More... more) const {
        const auto kernel = for_each_state<work, Of::running, block, 0, Real, More...>;
        open_chip(kernel);
        kernel<<<grid(1), block, bytes, stream>>>(model, slots, more...);
    }
    /// each_slot by blocks that fill the GPU once and have these arrays of the State's water on their chip. Returns
    /// whether there is room for them.
    template <auto work, int lanes, auto... arrays, class... More>
    bool each_slot_on_chip(int count, More... more) const {
        using Arrays = WaterOnChip<arrays...>;
        constexpr int block = 1024;
        const std::size_t bytes = Arrays::bytes(slots, count);
        if (!has_room_on_chip(bytes)) return false;
        const auto kernel = for_each_slot_on_chip<work, lanes, block, Arrays, Real, More...>;
        open_chip(kernel);
        const int blocks =
            std::clamp(device_attribute(cudaDevAttrMultiProcessorCount) / states, 1, blocks_for(count * lanes, block));
        kernel<<<grid(blocks), block, bytes, stream>>>(model, slots, count, more...);
        return true;
    }
    /// The same by at least so many threads for each State.
    template <auto work, int max_threads = grid_threads, int min_blocks = 0, class... More>
    void each_thread(int threads, More... more) const {
        const int block = block_for(threads, max_threads);
        for_each_state<work, Of::running, max_threads, min_blocks>
            <<<grid(blocks_for(threads, block)), block, 0, stream>>>(model, slots, more...);
    }
    /// The same for what is asked about all States, also those that are not advanced any more.
    template <auto work, class... More>
    void report_slots(int count, More... more) const {
        const int block = block_for(count, grid_threads);
        if (count > 0)
            for_each_slot<work, Of::all, 1, grid_threads, 0>
                <<<grid(blocks_for(count, block)), block, 0, stream>>>(model, slots, count, more...);
        check(cudaGetLastError(), "launch");
    }
    template <auto work, int block>
    void report_states(int blocks = 1) const {
        for_each_state<work, Of::all, block, 0><<<grid(blocks), block, 0, stream>>>(model, slots);
        check(cudaGetLastError(), "launch");
    }

    /// Sets a table of each State to 0.
    void clear(int* table, int count) const { clear_rows(table, slots.stride, count, states, stream); }
    /// Replaces its counts by the sums of all before each.
    void add_up(int* table, int count) const { exclusive_scan(table, count, states, slots.stride, scan_room, stream); }

    void mark(Stage stage) const {
        if (clock) clock->mark(stage);
    }
};

/// Launches the stages of substep `slots.substep`.
template <class Real>
void launch_substep(const GridLaunch<Real>& launch);
template <class Real, Scheme scheme>
void launch_substep_of(const GridLaunch<Real>& launch);
/// A substep of scheme conserving without lists of the water's neighbours.
template <class Real>
void launch_substep_without_lists(const GridLaunch<Real>& launch);

template <class Real, Scheme scheme>
void launch_predict(const GridLaunch<Real>& launch);
template <class Real>
void launch_sort_into_cells(const GridLaunch<Real>& launch);
template <class Real>
void launch_find_neighbours(const GridLaunch<Real>& launch);

/// Of the first State: writes positions of all slots, with the particles' numbers, to row `row` of an observer's view
/// if there is one.
template <class Real>
void record_positions(const GridLaunch<Real>& launch, Vec4<Real>* to, int row);

/// Places of the body's particles as the State has them, in the order of Body::particles, by State.
template <class Real>
void launch_body_places(const GridLaunch<Real>& launch, Vec4<Real>* places);
/// Densities of the fluid and numbers of neighbours, by State and number, as the last substep left them.
template <class Real>
void launch_densities(const GridLaunch<Real>& launch, Real* density);
template <class Real>
void launch_neighbour_counts(const GridLaunch<Real>& launch, int* counts);
/// Likewise of the fluid, for scheme conserving: sums of the last substep's pressure impulses.
template <class Real>
void launch_pressures(const GridLaunch<Real>& launch, Real* pressures);

/// Reads what a pass over the pairs of the water reads, and writes its sum by State and slot.
template <class Real>
void launch_fetch(const GridLaunch<Real>& launch, Fetch what, Real* sums);

/// Adds the work of the muscles in the substep to that of the update, into what all share.
template <class Real>
void launch_work(const GridLaunch<Real>& launch);

/// Mean x of the body, mean z of its tail, and whether it touches a plane, into what all share.
template <class Real>
void launch_measure(const GridLaunch<Real>& launch);

/// Copies the States that go on, one behind the other.
template <class Real>
void launch_keep(const GridLaunch<Real>& launch, Vec4<Real>* position, Vec4<Real>* velocity, ClusterFit<Real>* fits);

/// Sets all velocities of the State to 0.
template <class Real>
void launch_rest(const GridLaunch<Real>& launch);

/// Sets the slot far from all others.
template <class Real>
void launch_far_slot(const GridLaunch<Real>& launch);

/// The stages of a substep that schemes share, each a launch or several.
template <Scheme scheme_of_step, class R>
struct LaunchStages {
    using Real = R;
    static constexpr Scheme scheme = scheme_of_step;

    const GridLaunch<Real>& launch;
    const ModelView<Real>& model = launch.model;
    const Slots<Real>& slots = launch.slots;
    int blocks = blocks_for(model.particles, grid_threads);
    int iteration = 0;

    void predict() { launch_predict<Real, scheme>(launch); }
    void sort_into_cells() { launch_sort_into_cells(launch); }
    template <class AfterStage>
    void find_neighbours(const AfterStage&) {
        launch_find_neighbours(launch);
    }
};

/// Takes the time of the stages, and writes down what an observer sees.
template <class Stages>
struct AfterLaunch {
    Stages& stages;
    void operator()(Stage stage) const {
        const GridLaunch<typename Stages::Real>& launch = stages.launch;
        if (stage != Stage::iteration) launch.mark(stage);
        if (stage == Stage::cells) record_positions(launch, launch.trace.predicted, launch.slots.substep);
        if (stage == Stage::iteration)
            record_positions(launch, launch.trace.iterated,
                             launch.slots.substep * launch.model.iterations + stages.iteration++);
    }
};

}  // namespace natator::cuda
