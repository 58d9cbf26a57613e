// A batch of States of one Model of scheme flex: a team per State, a whole update per turn, everything between two updates on
// the device. Teams take (update, State) pairs from a queue, so that 150 States keep 132 multiprocessors busy.
#include "batch_kernel.cuh"

#include <algorithm>

#include "device_buffer.h"
#include "layout.cuh"

namespace natator::cuda {
namespace {

template <class Real>
const void* kernel(const ModelView<Real>& model, bool on_chip) {
    return model.plan.effects() ? batch_kernel<Real, true>(on_chip) : batch_kernel<Real, false>(on_chip);
}

int attribute(cudaDeviceAttr what) {
    int device = 0, value = 0;
    check(cudaGetDevice(&device), "current device");
    check(cudaDeviceGetAttribute(&value, what, device), "attribute of the device");
    return value;
}

/// What a launch of so many teams is asked with; `attribute` is part of it.
cudaLaunchConfig_t configuration(const Teams& teams, int count, unsigned chip_bytes, cudaLaunchAttribute& attribute) {
    attribute.id = cudaLaunchAttributeClusterDimension;
    attribute.val.clusterDim = {static_cast<unsigned>(teams.blocks), 1, 1};
    cudaLaunchConfig_t launch{};
    launch.gridDim = dim3(count * teams.blocks);
    launch.blockDim = dim3(threads);
    launch.dynamicSmemBytes = chip_bytes;
    launch.attrs = &attribute;
    launch.numAttrs = teams.blocks > 1 ? 1 : 0;
    return launch;
}

/// How many teams the current device can hold at a time; 0 if a block does not fit on its chip.
template <class Real>
int resident(const ModelView<Real>& model, const Teams& teams) {
    if (teams.on_chip && model.plan.effects()) return 0;  // no such kernel: they are rare, and take long to compile
    const void* const function = kernel(model, teams.on_chip);
    cudaFuncAttributes attributes{};
    check(cudaFuncGetAttributes(&attributes, function), "kernel");
    const int most_bytes =
        attribute(cudaDevAttrMaxSharedMemoryPerBlockOptin) - static_cast<int>(attributes.sharedSizeBytes);
    const unsigned bytes = layout_of(model, teams.on_chip).chip_bytes;
    if (most_bytes < 0 || bytes > static_cast<unsigned>(most_bytes)) return 0;
    // The limit belongs to the kernel, for all Models and threads: one of this Model alone could come between another's limit and
    // its launch.
    check(cudaFuncSetAttribute(function, cudaFuncAttributeMaxDynamicSharedMemorySize, most_bytes), "shared memory");
    int count = 0;
    if (teams.blocks == 1) {
        check(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&count, function, threads, bytes), "occupancy");
        return count * attribute(cudaDevAttrMultiProcessorCount);
    }
    check(cudaFuncSetAttribute(function, cudaFuncAttributeNonPortableClusterSizeAllowed, 1), "clusters");
    cudaLaunchAttribute cluster;
    const cudaLaunchConfig_t launch = configuration(teams, 1, bytes, cluster);
    check(cudaOccupancyMaxActiveClusters(&count, function, &launch), "occupancy");
    return count;
}

/// What a frame of 4 substeps takes a team, microseconds, nearly: measured on an H100 with 5915 and 16 223 particles.
double time_of(const Teams& teams, int particles) {
    return teams.on_chip ? 0.236 * particles : 330 + 0.24 * particles / teams.blocks;
}

}  // namespace

template <class Real>
Teams best_teams(const ModelView<Real>& model, int states) {
    Teams best{};
    double least = 0;
    const auto consider = [&](Teams teams) {
        teams.count = resident(model, teams);
        if (teams.count == 0) return;
        const double time = time_of(teams, model.particles) * std::max(1.0, static_cast<double>(states) / teams.count);
        if (best.count > 0 && time >= least) return;
        best = teams;
        least = time;
    };
    consider({.on_chip = true, .blocks = 1});
    const int most_blocks = attribute(cudaDevAttrClusterLaunch) ? most_blocks_of_team : 1;
    for (int blocks = 1; blocks <= most_blocks; blocks *= 2) consider({.on_chip = false, .blocks = blocks});
    return best;
}

template <class Real>
void launch_batch(const BatchView<Real>& batch, const Teams& teams) {
    BatchView<Real> argument = batch;
    void* arguments[] = {&argument};
    cudaLaunchAttribute cluster;
    const cudaLaunchConfig_t launch =
        configuration(teams, std::min(teams.count, batch.states), batch.layout.chip_bytes, cluster);
    check(cudaLaunchKernelExC(&launch, kernel(batch.model, teams.on_chip), arguments), "launch");
}

template Teams best_teams(const ModelView<float>&, int);
template Teams best_teams(const ModelView<double>&, int);
template void launch_batch(const BatchView<float>&, const Teams&);
template void launch_batch(const BatchView<double>&, const Teams&);

}  // namespace natator::cuda
