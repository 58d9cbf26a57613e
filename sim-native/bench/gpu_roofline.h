#pragma once

#include <functional>
#include <string>

#include "natator/evaluate.h"
#include "result_table.h"

namespace natator::bench {

/// How near the density constraint of scheme conserving, where most of its time goes, comes to what a GPU could do: to
/// a kernel that only fetches what it reads of pairs, from the same lists by the same threads. In floats.
struct GpuRooflineStudy {
    int frames =
        60;  ///< of creature 1 in the thesis' tank, 150 times, and of 47 000 particles, 16 times, after settling
    int device = 0;
    bool quick = false;  ///< a few of the evaluations and frames
};

/// Columns kind, name, scene, evaluations, device (these are the key); bytes_per_pair; pairs: of all evaluations in one
/// launch, of the constraint in both; seconds; million_pairs_per_second; gbytes_per_second, in units of 10^9; share.
/// Rows of kind "bandwidth": memory that is copied, bytes in and out. Of kind "fetch": what the constraint's impulses
/// read of a pair, its place in the list, its gradient and the neighbour's velocity, and what its push reads, the
/// neighbour's impulse instead. Of kind "stage": a pass of the constraint, impulses and push, from the profile of a
/// run; share: of its time what the two fetches take.
Row gpu_roofline_columns();
inline constexpr std::size_t gpu_roofline_key_columns = 5;

/// Runs what `table` does not hold yet. `report` gets a line per row. Throws NoDevice without that GPU.
void run_gpu_roofline_study(const GpuRooflineStudy& study, ResultTable& table,
                            const std::function<void(const std::string&)>& report);

}  // namespace natator::bench
