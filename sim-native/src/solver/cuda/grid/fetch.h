#pragma once

namespace natator::cuda {

/// Data that a pass over the pairs of the water reads at a neighbour's slot.
enum class Fetch { velocities, impulses };

}  // namespace natator::cuda
