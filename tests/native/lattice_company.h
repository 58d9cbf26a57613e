#pragma once

#include <nlohmann/json.hpp>

#include "natator/gait.h"

namespace natator::test {

/// What a loach swims by.
inline const Gait loach_wave{2, {0.4, 0.35, 0.3, 0.25, 0.2}, {0, 0.902, 0.804, 0.706, 0.608}};

/// Overrides of plane/pair for quick swims, in fewer cells, and changes of these.
inline nlohmann::json pair_json(const nlohmann::json& changes) {
    nlohmann::json overrides = {{"duration", 0.5},
                                {"fluid", {{"disorder", 0}, {"count", {160, 1, 96}}}},
                                {"planes", {{1, 0, 0, 0}, {-1, 0, 0, 3.2}, {0, 0, 1, 0}, {0, 0, -1, 1.92}}}};
    overrides.merge_patch(changes);
    return overrides;
}

/// Changes of these: a loach and another beside a ball and a box, in a current.
inline const nlohmann::json crowd = {
    {"duration", 0.4},
    {"planes", nlohmann::json::array()},
    {"fluid", {{"current", {-0.2, 0, 0}}}},
    {"stopping", {{"noProgressAfter", 0}}},
    {"obstacles",
     {{{"shape", "sphere"}, {"centre", {2.2, 0.01, 0.9}}, {"radius", 0.1}, {"spacing", 0.04}},
      {{"shape", "box"}, {"centre", {2.2, 0.01, 1.4}}, {"size", {0.1, 0.02, 0.2}}, {"spacing", 0.02}}}}};

}  // namespace natator::test
