#pragma once

#include <functional>
#include <string>
#include <vector>

#include "natator/evaluate.h"
#include "result_table.h"

namespace natator::bench {

/// What a stage costs when a scene needs it and when it does not.
struct StageCostStudy {
    std::vector<std::string> features;  ///< stage_feature_names()
    std::vector<Scheme> schemes;
    std::vector<std::string> states{"off", "on"};
    int repeats = 3;
    bool quick = false;         ///< two frames
    bool skipped_only = false;  ///< leaves the columns of what is not skipped empty
};

/// Features of a scene that have stages of their own or branches in one: fluid, creature, viscosity, cohesion …
/// The thesis tank with creature 1 is the scene; `off` and `on` differ in the feature alone.
std::vector<std::string> stage_feature_names();

/// Columns feature, scheme, state, machine (these are the key); stage: where the feature works; calls and
/// stage_ms_per_frame: of that stage, 0 when it does not run; ms_per_frame: of the whole evaluation; hash;
/// unskipped_ms_per_frame and unskipped_hash: the same with all stages run, needed or not. Times are the least of the
/// repeats.
Row stage_cost_columns();
inline constexpr std::size_t stage_cost_key_columns = 4;

/// Runs what `table` does not hold yet, the states of a feature in turns. `report` gets a line per row.
void run_stage_cost_study(const StageCostStudy& study, ResultTable& table,
                          const std::function<void(const std::string&)>& report);

}  // namespace natator::bench
