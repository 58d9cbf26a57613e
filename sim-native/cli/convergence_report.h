#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "level_runs.h"

namespace natator::cli {

/// The answer of `natator-sim converge`; its fields: sim-native/protocol/converge.md.
nlohmann::ordered_json convergence_json(const std::vector<LevelRuns>& levels, const std::optional<Estimate>& estimate);

/// The same as a table for people, a line for each level, then the estimate.
std::string convergence_table(const std::vector<LevelRuns>& levels, const std::optional<Estimate>& estimate);

}  // namespace natator::cli
