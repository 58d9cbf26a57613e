#pragma once

#include "natator/model.h"

namespace natator::cuda {

/// Blocks have 16 bits for a slot.
inline constexpr int max_particles_of_a_block = 65535;
/// Up to so many particles, only kernels for blocks of its own are there for a scene of scheme flex, but where the
/// whole GPU must.
inline constexpr int max_particles_by_blocks_alone = 20000;

/// Do blocks and the whole GPU compute a Model alike? In float and without effects (Plan::effects) both ways give the
/// same bits: cells are the same, and the host sets the muscles.
inline bool supports_both(const Model& model) {
    return model.scheme == Scheme::flex && model.particles() > max_particles_by_blocks_alone;
}

}  // namespace natator::cuda
