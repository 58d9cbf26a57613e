#pragma once

#include "natator/batch.h"
#include "natator/model.h"

namespace natator::cuda {

/// Whether the current device computes a scene by kernels of the whole GPU: in scheme conserving, with goals or
/// companions, and where it is asked for, always; above 20 000 particles where both ways do not give the same bits, or
/// blocks have no room for it.
bool uses_grid_kernels(const Scene& scene, const Model& model, const BatchOptions& options);

}  // namespace natator::cuda
