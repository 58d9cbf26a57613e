#include "merge_patches.h"

namespace natator {

nlohmann::json merge_patches(nlohmann::json first, const nlohmann::json& second) {
    if (!first.is_object() || !second.is_object()) return second;
    for (const auto& [key, value] : second.items())
        first[key] = first.contains(key) ? merge_patches(std::move(first[key]), value) : value;
    return first;
}

}  // namespace natator
