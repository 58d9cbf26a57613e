#pragma once

#include <nlohmann/json.hpp>

namespace natator {

/// The merge patch (RFC 7386) that does what `first` and then `second` do: like `second` applied to `first`, but a null
/// stays, because it takes a key out of what both are applied to.
nlohmann::json merge_patches(nlohmann::json first, const nlohmann::json& second);

}  // namespace natator
