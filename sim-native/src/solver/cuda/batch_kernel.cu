// A batch of States of one Model: a block per State, a whole update per turn, everything between two updates on the
// device. Blocks take (update, State) pairs from a queue, so that 150 States keep 132 multiprocessors busy.
#include "batch_kernel.cuh"

#include <algorithm>

#include "device_buffer.h"
#include "flex.cuh"
#include "measure.cuh"
#include "neighbours.cuh"

namespace natator::cuda {
namespace {

/// Hands out aligned pieces of one piece of memory; with a null base it only adds up their sizes.
class Pieces {
public:
    __host__ __device__ explicit Pieces(char* base) : base_(base) {}
    template <class T>
    __host__ __device__ T* take(std::size_t count) {
        constexpr std::size_t alignment = 16;
        T* const piece = reinterpret_cast<T*>(base_ + used_);
        used_ += (count * sizeof(T) + alignment - 1) / alignment * alignment;
        return piece;
    }
    __host__ __device__ std::size_t used() const { return used_; }

private:
    char* base_;
    std::size_t used_ = 0;
};

/// Positions, and room for the cells' tables and the sort's keys in the second array of them.
template <class Real>
__host__ __device__ void place_positions(const ModelView<Real>& model, Pieces& pieces, Block<Real>& block) {
    const std::size_t table = (2 * model.grid.cells + model.particles) * sizeof(int);
    const std::size_t at_least = (table + sizeof(Quad<Real>) - 1) / sizeof(Quad<Real>);
    const std::size_t particles = model.particles;
    block.position = pieces.take<Quad<Real>>(particles > at_least ? particles : at_least);
    block.next = pieces.take<Quad<Real>>(particles > at_least ? particles : at_least);
    block.compression = pieces.take<Real>(model.fluid);
}

template <class Real>
__host__ __device__ void place_on_chip(const ModelView<Real>& model, bool on_chip, Pieces& pieces, Block<Real>& block) {
    if (on_chip) place_positions(model, pieces, block);
    block.slot_of_solid = pieces.take<std::uint16_t>(model.solids);
    block.rest_length = pieces.take<Real>(model.springs);
    block.fit = pieces.take<ClusterFit<Real>>(model.clusters);
    block.scan = pieces.take<int>(warps);
}

template <class Real>
__host__ __device__ void place_in_scratch(const ModelView<Real>& model, bool on_chip, Pieces& pieces,
                                          Block<Real>& block) {
    if (!on_chip) place_positions(model, pieces, block);
    const std::size_t particles = model.particles, fluid = model.fluid, solids = model.solids;
    block.predicted = pieces.take<Quad<Real>>(particles);
    block.drift = pieces.take<Quad<Real>>(particles);
    block.drift_before = pieces.take<Quad<Real>>(particles);
    block.start = pieces.take<Quad<Real>>(particles);
    block.neighbour = pieces.take<std::uint16_t>(fluid * model.most_neighbours);
    block.neighbour_count = pieces.take<std::uint16_t>(fluid);
    block.fluid_contact = pieces.take<std::uint16_t>(model.plan.contacts ? fluid * solids : 0);
    block.solid_contact = pieces.take<std::uint16_t>(model.plan.contacts ? solids * particles : 0);
    block.contact_count = pieces.take<std::uint16_t>(particles);
    block.plane_contact = pieces.take<std::uint16_t>(particles);
}

/// As gait/actuate.cpp, scheme flex.
template <class Real>
__device__ void actuate(const ModelView<Real>& model, const GaitView& gait, int state, double time, bool at_rest,
                        Block<Real>& block) {
    for (int s = threadIdx.x; s < model.springs; s += threads) block.rest_length[s] = model.spring[s].rest_length;
    __syncthreads();
    if (at_rest) return;
    for (int m = threadIdx.x; m < model.muscles; m += threads) {
        const MuscleView muscle = model.muscle[m];
        const int a = state * model.actuators + muscle.actuator;
        const double sine = sinpi(2 * (gait.frequency[state] * time + gait.phase[a]));
        const double power = gait.power[state];
        const double activation = power == 1 ? sine : pow((sine + 1) / 2, power) * 2 - 1;
        constexpr double epsilon = 0.5;  // thesis 2.8
        const double length = muscle.rest_length * (1 + epsilon * muscle.lateral * gait.amplitude[a] * activation);
        block.rest_length[muscle.spring] = static_cast<Real>(length);
    }
    __syncthreads();
}

/// One substep of scheme flex: the order of stages is that of step.h. True if the outcome is finite.
template <class Real>
__device__ bool substep(const ModelView<Real>& model, Block<Real>& block) {
    predict(model, block);
    sort_into_cells(model, block);
    find_neighbours(model, block);
    for (int i = 0; i < model.iterations; ++i) iterate_summed(model, block);
    return !__syncthreads_or(!update_velocities(model, block));
}

/// Notes an unstable outcome: the lowest particle that is not finite.
template <class Real>
__device__ void note_instability(const ModelView<Real>& model, const Block<Real>& block, double time,
                                 Progress& progress) {
    if (threadIdx.x != 0) return;
    int lowest = model.particles;
    for (int s = 0; s < model.particles; ++s) {
        const Quad<Real> x = block.position[s], v = block.velocity[s];
        if (!isfinite(x.x + x.y + x.z) || !isfinite(v.x + v.y + v.z)) lowest = min(lowest, number_in(x.w));
    }
    progress.stopped = static_cast<int>(Stopped::unstable);
    progress.bad_particle = lowest;
    progress.bad_time = time;
}

/// One update of one State by this block.
template <class Real>
__device__ void update(const BatchView<Real>& batch, int state, int update, Block<Real>& block) {
    const ModelView<Real>& model = batch.model;
    Quad<Real>* const position = batch.position + static_cast<std::size_t>(state) * model.particles;
    ClusterFit<Real>* const fit = batch.fit + state * model.clusters;
    Progress& progress = batch.progress[state];
    block.velocity = batch.velocity + static_cast<std::size_t>(state) * model.particles;
    for (int s = threadIdx.x; s < model.particles; s += threads) {
        block.position[s] = position[s];
        if (s >= model.fluid)
            block.slot_of_solid[number_in(position[s].w) - model.fluid] = static_cast<std::uint16_t>(s);
    }
    for (int k = threadIdx.x; k < model.clusters; k += threads) block.fit[k] = fit[k];
    block.h = static_cast<Real>(batch.time_step) / static_cast<Real>(batch.substeps);
    const double time = batch.settling ? 0 : update * batch.time_step;
    actuate(model, batch.gait, state, time, batch.settling, block);
    __syncthreads();
    double* const path = batch.path + static_cast<std::size_t>(state) * (batch.updates + 1);
    if (!batch.settling && update == 0) measure_path(model, block, path);

    for (int k = 0; k < batch.substeps; ++k) {
        if (substep(model, block)) continue;
        note_instability(model, block, time + k * batch.time_step / batch.substeps, progress);
        break;
    }
    __syncthreads();
    for (int s = threadIdx.x; s < model.particles; s += threads) {
        position[s] = block.position[s];
        if (batch.settling) block.velocity[s] = {};
    }
    for (int k = threadIdx.x; k < model.clusters; k += threads) fit[k] = block.fit[k];
    if (batch.settling || progress.stopped >= 0) return;
    measure_path(model, block, path + update + 1);
    const bool touches = batch.stop_at_planes && touches_plane(model, block);
    if (threadIdx.x == 0) {
        progress.frames = update + 1;
        const int window = batch.no_progress_frames;
        if (touches)
            progress.stopped = static_cast<int>(Stopped::touched_plane);
        else if (window > 0 && update + 1 >= window && path[update + 1] - path[update + 1 - window] <= 0)
            progress.stopped = static_cast<int>(Stopped::no_progress);
    }
    __syncthreads();
    const bool last = progress.stopped >= 0 || update + 1 == batch.updates;
    if (last && batch.density && model.plan.fluid) {
        compute_density(model, block);
        for (int s = threadIdx.x; s < model.fluid; s += threads)
            batch.density[static_cast<std::size_t>(state) * model.fluid + number_in(block.position[s].w)] =
                block.compression[s] + 1;
    }
}

/// Takes tickets until there are none. A ticket's State may still be in the hands of another block, which then works
/// on an earlier ticket: waiting cannot lock up.
template <class Real, bool on_chip>
__global__ void __launch_bounds__(threads, 1) advance(BatchView<Real> batch) {
    extern __shared__ __align__(16) char chip[];
    __shared__ unsigned ticket;
    Block<Real> block;
    Pieces on_chip_pieces(chip), in_scratch(batch.scratch + blockIdx.x * batch.scratch_bytes);
    place_on_chip(batch.model, on_chip, on_chip_pieces, block);
    place_in_scratch(batch.model, on_chip, in_scratch, block);
    for (;;) {
        if (threadIdx.x == 0) ticket = atomicAdd(batch.next_ticket, 1u);
        __syncthreads();
        const unsigned mine = ticket;
        if (mine >= static_cast<unsigned>(batch.states) * batch.updates) return;
        const int state = mine % batch.states, number = mine / batch.states;
        if (threadIdx.x == 0) {
            while (*static_cast<volatile int*>(batch.updates_done + state) < number) __nanosleep(100);
            __threadfence();
        }
        __syncthreads();
        if (*static_cast<volatile int*>(&batch.progress[state].stopped) < 0) update(batch, state, number, block);
        __threadfence();
        __syncthreads();
        if (threadIdx.x == 0) *static_cast<volatile int*>(batch.updates_done + state) = number + 1;
    }
}

template <class Real>
const void* kernel(bool on_chip) {
    return on_chip ? reinterpret_cast<const void*>(&advance<Real, true>)
                   : reinterpret_cast<const void*>(&advance<Real, false>);
}

}  // namespace

template <class Real>
std::size_t chip_bytes(const ModelView<Real>& model, bool on_chip) {
    Block<Real> block;
    Pieces pieces(nullptr);
    place_on_chip(model, on_chip, pieces, block);
    return pieces.used();
}

template <class Real>
std::size_t scratch_bytes(const ModelView<Real>& model, bool on_chip) {
    Block<Real> block;
    Pieces pieces(nullptr);
    place_in_scratch(model, on_chip, pieces, block);
    return (pieces.used() + 127) / 128 * 128;
}

template <class Real>
int resident_blocks(const ModelView<Real>& model, bool on_chip) {
    int device = 0, most_chip_bytes = 0, processors = 0, per_processor = 0;
    check(cudaGetDevice(&device), "current device");
    check(cudaDeviceGetAttribute(&most_chip_bytes, cudaDevAttrMaxSharedMemoryPerBlockOptin, device), "shared memory");
    check(cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, device), "multiprocessors");
    cudaFuncAttributes attributes{};
    check(cudaFuncGetAttributes(&attributes, kernel<Real>(on_chip)), "kernel");
    const std::size_t bytes = chip_bytes(model, on_chip);
    if (bytes + attributes.sharedSizeBytes > static_cast<std::size_t>(most_chip_bytes)) return 0;
    check(cudaFuncSetAttribute(kernel<Real>(on_chip), cudaFuncAttributeMaxDynamicSharedMemorySize,
                               static_cast<int>(bytes)),
          "shared memory");
    check(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&per_processor, kernel<Real>(on_chip), threads, bytes),
          "occupancy");
    return processors * per_processor;
}

template <class Real>
void launch_batch(const BatchView<Real>& batch, bool on_chip, int blocks) {
    BatchView<Real> argument = batch;
    void* arguments[] = {&argument};
    const int most = std::min(blocks, batch.states);
    check(cudaLaunchKernel(kernel<Real>(on_chip), dim3(most), dim3(threads), arguments,
                           chip_bytes(batch.model, on_chip), nullptr),
          "launch");
}

template std::size_t chip_bytes(const ModelView<float>&, bool);
template std::size_t chip_bytes(const ModelView<double>&, bool);
template std::size_t scratch_bytes(const ModelView<float>&, bool);
template std::size_t scratch_bytes(const ModelView<double>&, bool);
template int resident_blocks(const ModelView<float>&, bool);
template int resident_blocks(const ModelView<double>&, bool);
template void launch_batch(const BatchView<float>&, bool, int);
template void launch_batch(const BatchView<double>&, bool, int);

}  // namespace natator::cuda
