#pragma once

#include "natator/batch.h"
#include "natator/model.h"

namespace natator::cuda {

/// Blocks have 16 bits for a slot.
inline constexpr int most_particles_of_a_block = 65535;
/// Up to so many particles, blocks of its own are always the faster way for a scene of scheme flex.
inline constexpr int most_particles_by_blocks_alone = 20000;

/// Do blocks and the whole GPU compute a Model alike? In float and without effects (Plan::effects) both ways give the same bits:
/// cells are the same, and the host sets the muscles.
bool goes_either_way(const Model& model);

/// Whether so many members are computed by kernels of the whole GPU, on the current device: in scheme conserving, with goals or
/// companions, and where it is asked for, always; above 20 000 particles where both ways do not give the same bits, or it is faster.
bool by_whole_gpu(const Scene& scene, const Model& model, int members, const BatchOptions& options);

}  // namespace natator::cuda
