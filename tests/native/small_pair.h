#pragma once

#include <nlohmann/json.hpp>

namespace natator::test {

/// Overrides of bench/small-tank: its swimmer, of 2 actuators, and beside it another, of 3.
inline const nlohmann::json small_pair = {
    {"settling", {{"updates", 2}}},
    {"planes", {{0, 1, 0, 0}, {0, 0, 1, 0}, {1, 0, 0, 0}, {-1, 0, 0, 1.54}, {0, 0, -1, 1.58}}},
    {"fluid", {{"count", {17, 7, 17}}}},
    {"companions",
     {{{"creature",
        {{"slices", {{{"height", 3}, {"width", 3}, {"count", 9}}}},
         {"joints", {1, 3, 5, 7}},
         {"rearCentre", {0.42, 0.42, 1.16}}}},
       {"gait", {{"frequency", 2}, {"amplitude", {0.5, 0.4, 0.3}}, {"phase", {0, 0.2, 0.4}}}}}}}};

}  // namespace natator::test
