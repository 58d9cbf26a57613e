#pragma once

#include <nlohmann/json.hpp>

namespace natator::test {

/// Overrides of lake/creature-2 for quick swims: few cells, and a body of few of them.
inline const nlohmann::json coarse_lake{{"solver", {{"substeps", 16}}},
                                        {"fluid",
                                         {{"count", {60, 24, 24}},
                                          {"spacing", 0.075},
                                          {"origin", {0.0375, 0.0375, 0.0375}},
                                          {"mass", {{"bottom", 0.421875}}},
                                          {"disorder", 0}}}};

}  // namespace natator::test
