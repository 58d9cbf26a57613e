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

/// Numbers in the room of a part of so many planes: moments of two rows of each and of two planes, and populations of a
/// strip in three planes, with a row beside each end.
inline std::size_t room_of(const View& view, int planes) {
    const long kept = 2L * physics::lattice_moments * (planes + view.ny);
    const long passing = 3L * physics::lattice_populations * (view.rows + 2);
    return static_cast<std::size_t>((kept + passing) * view.stride + 2 * margin);
}

/// Kernels of the lattice in one instruction set, in float.
template <class Real>
struct Kernels {
    /// Populations after collision of `count` cells: of cell k population i is to[(k / 16 * 27 + i) * 16 + k % 16].
    void (*collide)(const View& view, const physics::LatticeRates& rates, const long* cells, int count, float* to);
    /// Before any of them advances, each part of the planes, [begin, end) along z, keeps those beside it.
    void (*keep)(const View& view, int begin, int end, float* room);
    /// A step of a part, in place.
    void (*advance)(const View& view, const physics::LatticeRates& rates, int begin, int end, float* room);
};

NATATOR_DECLARE_KERNELS(Kernels, kernels)

}  // namespace natator::lattice
