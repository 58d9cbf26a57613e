#pragma once

#include "../cpu/kernel_table.h"
#include "physics/lattice.h"

namespace natator::lattice {

constexpr int margin = 16;  ///< cells before and behind a row

/// Arrays of a lattice in memory: rows of cells along x, then along y, then along z.
struct View {
    int nx, ny, nz, stride;                          ///< stride: of rows, numbers
    int rows;                                        ///< along y, that are advanced at once: a strip
    bool bounces[3][2], mirrors[3][2], opens[3][2];  ///< at the ends along x, y, z; none of them: periodic
    float* now[physics::lattice_moments];
    const float* change[3];                             ///< of the velocity, cells/step
    const unsigned char* row_changes;                   ///< by row: whether there is any
    const float* inflow[physics::lattice_populations];  ///< a row of what comes in at open ends
};

/// Kernels of the lattice in one instruction set, in float.
template <class Real>
struct Kernels {
    /// Populations after collision of `count` cells: of cell k population i is to[(k / 16 * 27 + i) * 16 + k % 16].
    void (*collide)(const View& view, const physics::LatticeRates& rates, const long* cells, long count, float* to);
    /// A step in place of a part of the planes, [begin, end) along z, once all parts have kept the planes beside them.
    /// Both get the same `room`: stride x (3 x 27 x (rows + 2) + 2 x 17 x (ny + planes of the part)) numbers and 32
    /// more; where a strip is all rows, planes need none.
    void (*keep)(const View& view, int begin, int end, float* room);
    void (*advance)(const View& view, const physics::LatticeRates& rates, int begin, int end, float* room);
};

NATATOR_DECLARE_KERNELS(Kernels, kernels)

}  // namespace natator::lattice
