#pragma once

#include <functional>
#include <string>
#include <vector>

#include "natator/scene.h"
#include "result_table.h"

namespace natator::bench {

/// How near the stages come to what the processor can do, after Williams, Waterman, Patterson: Roofline: An Insightful
/// Visual Performance Model (2009). One thread.
struct RooflineStudy {
    std::vector<Scheme> schemes;
    int frames = 60;  ///< of the thesis tank with creature 1, after settling
};

/// Columns kind, name, scheme, instruction_set, machine (these are the key); then, of a roof: gflops (kind "compute")
/// or gbytes_per_second (kind "bandwidth"), in units of 10^9 per second; of a stage (kind "stage"): flops_per_pair and
/// bytes_per_pair as counted in the kernels' source, pairs per frame, seconds per frame, gflops, gbytes_per_second, and
/// intensity, flops per byte. The search's pairs are the candidates that it measures, the others' the neighbours found.
Row roofline_columns();
inline constexpr std::size_t roofline_key_columns = 5;

/// Runs what `table` does not hold yet. `report` gets a line per row.
void run_roofline_study(const RooflineStudy& study, ResultTable& table,
                        const std::function<void(const std::string&)>& report);

}  // namespace natator::bench
