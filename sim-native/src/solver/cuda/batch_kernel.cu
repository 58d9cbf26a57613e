// A batch of States of one Model of scheme flex: a team per State, a whole update per turn, everything between two updates on
// the device. Teams take (update, State) pairs from a queue, so that 150 States keep 132 multiprocessors busy.
#include "batch_kernel.cuh"

#include <algorithm>

#include "device_buffer.h"
#include "layout.cuh"
#include "way.h"

namespace natator::cuda {
namespace {

template <class Real>
const void* kernel(const ModelView<Real>& model, bool on_chip) {
    return model.plan.effects() ? batch_kernel<Real, true>(on_chip) : batch_kernel<Real, false>(on_chip);
}

/// What a launch of so many teams is asked with; `cluster` is part of it.
cudaLaunchConfig_t configuration(const Teams& teams, int count, cudaLaunchAttribute& cluster) {
    cluster.id = cudaLaunchAttributeClusterDimension;
    cluster.val.clusterDim = {static_cast<unsigned>(teams.blocks), 1, 1};
    cudaLaunchConfig_t launch{};
    launch.gridDim = dim3(count * teams.blocks);
    launch.blockDim = dim3(threads);
    launch.dynamicSmemBytes = teams.layout.chip_bytes;
    launch.attrs = &cluster;
    launch.numAttrs = teams.blocks > 1 ? 1 : 0;
    return launch;
}

/// How many such clusters the current device holds at a time; 0 where it holds none, or the kernel was compiled for devices
/// that have none.
int resident_clusters(const void* function, const cudaFuncAttributes& attributes, const Teams& teams) {
    if (attributes.ptxVersion < 90) return 0;  // ClusterTeam's blocks are teams of their own there
    cudaLaunchAttribute cluster;
    const cudaLaunchConfig_t launch = configuration(teams, 1, cluster);
    int count = 0;
    const bool known =
        cudaFuncSetAttribute(function, cudaFuncAttributeNonPortableClusterSizeAllowed, 1) == cudaSuccess &&
        cudaOccupancyMaxActiveClusters(&count, function, &launch) == cudaSuccess;
    if (!known) cudaGetLastError();  // forgets that it was asked
    return known ? count : 0;
}

/// How many teams the current device holds at a time; 0 if a block does not fit on its chip, or a team on the device.
template <class Real>
int resident(const ModelView<Real>& model, const Teams& teams) {
    if (teams.on_chip && model.plan.effects()) return 0;  // no such kernel: they are rare, and take long to compile
    const void* const function = kernel(model, teams.on_chip);
    cudaFuncAttributes attributes{};
    check(cudaFuncGetAttributes(&attributes, function), "kernel");
    const int most_bytes =
        device_attribute(cudaDevAttrMaxSharedMemoryPerBlockOptin) - static_cast<int>(attributes.sharedSizeBytes);
    if (most_bytes < 0 || teams.layout.chip_bytes > static_cast<unsigned>(most_bytes)) return 0;
    // The limit belongs to the kernel, for all Models and threads: one of this Model alone could come between another's
    // limit and its launch.
    check(cudaFuncSetAttribute(function, cudaFuncAttributeMaxDynamicSharedMemorySize, most_bytes), "shared memory");
    if (teams.blocks > 1) return resident_clusters(function, attributes, teams);
    int count = 0;
    check(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&count, function, threads, teams.layout.chip_bytes), "occupancy");
    return count * device_attribute(cudaDevAttrMultiProcessorCount);
}

/// What a frame of 4 substeps takes a team, microseconds, nearly: measured on an H100 in float, with 1267 to 64 000 particles.
double time_of(const Teams& teams, int particles) {
    if (teams.on_chip) return 115 + 0.229 * particles;
    const double of_block = static_cast<double>(particles) / teams.blocks;
    if (!teams.layout.splits_solids) return 315 + 0.27 * of_block;
    return particles > most_particles_by_blocks_alone ? 255 + 0.323 * of_block : 280 + 0.2 * of_block;  // whose positions no cache holds
}

}  // namespace

template <class Real>
Teams best_teams(const ModelView<Real>& model, int states) {
    // Few rows fit the smallest chips, of 64 KiB; lists that are longer take longer.
    constexpr int small_chip = 96 << 10, few_rows = 24, rows = 40;
    const bool small = device_attribute(cudaDevAttrMaxSharedMemoryPerBlockOptin) < small_chip;
    Teams best{};
    double least = 0;
    const auto consider = [&](bool on_chip, int blocks) {
        Teams teams{.on_chip = on_chip, .blocks = blocks, .layout = layout_of(model, on_chip, blocks, small ? few_rows : rows)};
        teams.count = resident(model, teams);
        if (teams.count == 0) return;
        const double time = time_of(teams, model.particles) * std::max(1.0, static_cast<double>(states) / teams.count);
        if (best.count > 0 && time >= least) return;
        best = teams;
        least = time;
    };
    consider(true, 1);
    const int most_blocks = device_attribute(cudaDevAttrClusterLaunch) ? most_blocks_of_team : 1;
    for (int blocks = 1; blocks <= most_blocks; blocks *= 2) consider(false, blocks);
    if (best.count == 0) throw InputError("backend cuda: a block of threads does not fit on the device's chip");
    return best;
}

template <class Real>
void launch_batch(const BatchView<Real>& batch, const Teams& teams) {
    BatchView<Real> argument = batch;
    void* arguments[] = {&argument};
    cudaLaunchAttribute cluster;
    const cudaLaunchConfig_t launch = configuration(teams, std::min(teams.count, batch.states), cluster);
    check(cudaLaunchKernelExC(&launch, kernel(batch.model, teams.on_chip), arguments), "launch");
}

template Teams best_teams(const ModelView<float>&, int);
template Teams best_teams(const ModelView<double>&, int);
template void launch_batch(const BatchView<float>&, const Teams&);
template void launch_batch(const BatchView<double>&, const Teams&);

}  // namespace natator::cuda
