#pragma once

#include <string>

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// All that the settled start of a model depends on, as bytes: the model but for its muscles, the settling, the number
/// of bytes in a Real, the instruction set and the build of this code. Empty where the linker gave that no build id.
std::string settled_state_key(const Model& model, const Settling& settling, int real_bytes);

}  // namespace natator
