#pragma once

namespace natator::cuda {

/// Room in the lists of a State that kernels of the whole GPU compute.
struct ListRoom {
    int lists = 0;   ///< in scheme flex neighbours of a particle; in the water rows of all its lists, see water_row
    int copies = 0;  ///< of the water's particles: themselves and their ghosts
};

}  // namespace natator::cuda
