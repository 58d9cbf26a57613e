// A batch of States of one Model of scheme flex: a team per State, a whole update per turn, everything between two
// updates on the device. Teams take (update, State) pairs from a queue, so that 150 States keep 132 multiprocessors
// busy.
#include "batch_kernel.cuh"

#include <algorithm>

#include "solver/cuda/device_buffer.h"
#include "solver/cuda/kernel_choice.h"
#include "solver/cuda/layout.cuh"

namespace natator::cuda {
namespace {

template <class Real>
const void* kernel(const ModelView<Real>& model, TeamKind kind) {
    return model.plan.effects() ? batch_kernel<Real, true>(kind) : batch_kernel<Real, false>(kind);
}

/// How many blocks of such teams the current device holds at a time; 0 if one does not fit on its chip, or there is no
/// kernel.
template <class Real>
int resident_blocks(const ModelView<Real>& model, const Teams& teams) {
    const void* const function = kernel(model, teams.kind);
    if (!function) return 0;
    cudaFuncAttributes attributes{};
    check(cudaFuncGetAttributes(&attributes, function), "kernel");
    const int max_bytes =
        device_attribute(cudaDevAttrMaxSharedMemoryPerBlockOptin) - static_cast<int>(attributes.sharedSizeBytes);
    if (max_bytes < 0 || teams.layout.chip_bytes > static_cast<unsigned>(max_bytes)) return 0;
    // The limit belongs to the kernel, for all Models and threads: one of this Model alone could come between another's
    // limit and its launch.
    check(cudaFuncSetAttribute(function, cudaFuncAttributeMaxDynamicSharedMemorySize, max_bytes), "shared memory");
    int count = 0;
    check(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&count, function, threads_of(teams.kind),
                                                        teams.layout.chip_bytes),
          "occupancy");
    return count * device_attribute(cudaDevAttrMultiProcessorCount);
}

/// What a frame of 4 substeps takes a team, microseconds, nearly: measured on an H100 in float, with 1267 to 47 027
/// particles.
double time_of(const Teams& teams, int particles) {
    const double of_block = static_cast<double>(particles) / teams.blocks;
    switch (teams.kind) {
        case TeamKind::block:
            return 115 + 0.229 * particles;
        case TeamKind::many_blocks:
            return 175 + 0.98 * of_block;
        case TeamKind::blocks:
            break;
    }
    return teams.layout.splits_solids ? std::max(340.0, 205 + 0.327 * of_block) : 300 + 0.25 * of_block;
}

}  // namespace

template <class Real>
Teams best_teams(const ModelView<Real>& model, int states) {
    // Few rows fit the smallest chips, of 64 KiB; lists that are longer take longer.
    constexpr int small_chip = 96 << 10, few_rows = 24, rows = 40;
    const bool small = device_attribute(cudaDevAttrMaxSharedMemoryPerBlockOptin) < small_chip;
    Teams best{};
    double least = 0;
    const auto consider = [&](TeamKind kind, int blocks) {
        if (kind == TeamKind::many_blocks && !splits_solids(model, kind, blocks)) return;
        Teams teams{.kind = kind, .blocks = blocks, .layout = layout_of(model, kind, blocks, small ? few_rows : rows)};
        teams.count = resident_blocks(model, teams) / blocks;
        if (teams.count == 0) return;
        const double time = time_of(teams, model.particles) * std::max(1.0, static_cast<double>(states) / teams.count);
        if (best.count > 0 && time >= least) return;
        best = teams;
        least = time;
    };
    consider(TeamKind::block, 1);
    consider(TeamKind::blocks, 1);
    // However many teams there are at a time, each has as many blocks as there are for it.
    const int blocks =
        device_attribute(cudaDevAttrCooperativeLaunch) ? device_attribute(cudaDevAttrMultiProcessorCount) : 1;
    for (int count = 1, last = 0; count <= blocks / 2; ++count) {
        const int of_team = std::min(blocks / count, max_blocks_of_team);
        if (of_team == last) continue;
        consider(TeamKind::blocks, of_team);
        consider(TeamKind::many_blocks, of_team);
        last = of_team;
    }
    if (best.count == 0) throw InputError("backend cuda: a block of threads does not fit on the device's chip");
    return best;
}

template <class Real>
void launch_batch(const BatchView<Real>& batch, const Teams& teams) {
    BatchView<Real> argument = batch;
    void* arguments[] = {&argument};
    cudaLaunchAttribute all_at_once{};  // a team's blocks wait for each other
    all_at_once.id = cudaLaunchAttributeCooperative;
    all_at_once.val.cooperative = 1;
    cudaLaunchConfig_t launch{};
    launch.gridDim = dim3(teams.blocks, std::min(teams.count, batch.states));
    launch.blockDim = dim3(threads_of(teams.kind));
    launch.dynamicSmemBytes = teams.layout.chip_bytes;
    launch.attrs = &all_at_once;
    launch.numAttrs = teams.blocks > 1 ? 1 : 0;
    check(cudaLaunchKernelExC(&launch, kernel(batch.model, teams.kind), arguments), "launch");
}

template Teams best_teams(const ModelView<float>&, int);
template Teams best_teams(const ModelView<double>&, int);
template void launch_batch(const BatchView<float>&, const Teams&);
template void launch_batch(const BatchView<double>&, const Teams&);

}  // namespace natator::cuda
