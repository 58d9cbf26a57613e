#pragma once

#include <string>

#include "natator/model.h"

namespace natator {

/// All that a model is, as bytes: of models with the same, the same states go on in the same way.
std::string model_key(const Model& model);

/// All that its settled start depends on, as bytes: the model but for its muscles and their time step.
std::string start_key(const Model& model);

}  // namespace natator
