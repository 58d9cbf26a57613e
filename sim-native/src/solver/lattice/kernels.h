#pragma once

#include "../cpu/kernel_table.h"
#include "physics/lattice.h"

namespace natator::lattice {

constexpr int margin = 16;  ///< cells before and behind a row

/// Arrays of a lattice in memory: rows of cells along x, then along y, then along z.
struct View {
    int nx, ny, nz, stride;                          ///< stride: of rows, numbers
    int rows;                                        ///< along y, that are advanced at once
    bool beyond_caches;                              ///< whether it is so large that results go past them
    bool bounces[3][2], mirrors[3][2], opens[3][2];  ///< at the ends along x, y, z; none of them: periodic
    const float* now[physics::lattice_moments];
    float* next[physics::lattice_moments];
    const float* change[3];                             ///< of the velocity, cells/step
    const unsigned char* row_changes;                   ///< by row: whether there is any
    const float* inflow[physics::lattice_populations];  ///< a row of what comes in at open ends
};

/// Kernels of the lattice in one instruction set, in float.
template <class Real>
struct Kernels {
    /// Populations after collision of `count` cells: of cell k population i is to[(k / 16 * 27 + i) * 16 + k % 16].
    void (*collide)(const View& view, const physics::LatticeRates& rates, const long* cells, int count, float* to);
    /// A step of the planes [begin, end) along z. `room`: 3 x 27 x (rows + 2) x stride numbers and 32 more.
    void (*advance)(const View& view, const physics::LatticeRates& rates, int begin, int end, float* room);
};

NATATOR_DECLARE_KERNELS(Kernels, kernels)

}  // namespace natator::lattice
