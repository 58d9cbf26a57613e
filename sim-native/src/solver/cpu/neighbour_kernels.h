#pragma once

#include <cstdint>

#include "kernel_table.h"

namespace natator::cpu {

/// Runs of slots [begin[k], end[k]). Two arrays, so that what was written as two numbers is not read as one, which
/// would have to wait for the stores.
struct SlotRuns {
    static constexpr int max_runs = 18;
    int count = 0;
    int begin[max_runs];
    int end[max_runs];
};

/// Kernels that build lists of neighbours, in one instruction set.
template <class Real>
struct NeighbourKernels {
    /// Writes to `found` the slots of the runs that are nearer to `slot` than sqrt(distance_squared), without those at
    /// distance 0. Returns their number. `found` must have room for 16 entries more than the runs have slots, and the
    /// positions must go on for 16 slots behind each run.
    int (*find)(const Real* const position[3], int slot, const SlotRuns& runs, Real distance_squared,
                std::int32_t* found);
    /// Searches for `slot` and the slot behind it at once.
    void (*find_two)(const Real* const position[3], int slot, const SlotRuns& runs, Real distance_squared,
                     std::int32_t* const found[2], int count[2]);
    /// Lays 16 lists side by side: entry `lane` of row k is list[lane][k], or `filler` from count[lane] on. Writes
    /// `rows` rows; `to` must have room for the next multiple of 16 rows.
    void (*interleave)(const std::int32_t* const* list, const int* count, int rows, std::int32_t filler,
                       std::int32_t* to);
};

NATATOR_DECLARE_KERNELS(NeighbourKernels, neighbour_kernels)
/// The plain loops that they must agree with.
NATATOR_DECLARE_KERNELS(NeighbourKernels, scalar_neighbour_kernels)

}  // namespace natator::cpu
