#pragma once

#include "immersed.h"
#include "physics/lattice.h"

namespace natator::lattice {

/// Cells around a cube. Those beyond walls are left out; those beyond periodic ends count on, but for plane flow, of
/// one cell.
struct CellRange {
    int low[3], count[3];
    NATATOR_HD int size() const { return count[0] * count[1] * count[2]; }
    /// Where its cell number k is.
    NATATOR_HD void place(unsigned k, int (&to)[3]) const {
        const unsigned x = count[0], y = count[1], row = k / x, plane = row / y;
        to[0] = low[0] + static_cast<int>(k - row * x);
        to[1] = low[1] + static_cast<int>(row - plane * y);
        to[2] = low[2] + static_cast<int>(plane);
    }
};

NATATOR_HD CellRange cells_around(const Cube& cube, const int (&cells)[3], const bool (&periodic)[3]) {
    CellRange range;
    for (int a = 0; a < 3; ++a) {
        const float low = cube.x[a] - cube.reach[a], high = cube.x[a] + cube.reach[a];
        const bool on = periodic[a] && cells[a] > 1;
        const float least = on ? static_cast<float>(-cells[a]) : 0,
                    most = static_cast<float>(on ? 2 * cells[a] : cells[a]) - 1;
        int first = static_cast<int>(low < least ? least : low > most ? most + 1 : low);
        int last = static_cast<int>(high < least ? least - 1 : high > most ? most : high);
        if (static_cast<float>(first) < low) ++first;
        if (static_cast<float>(last) > high) --last;
        range.low[a] = first;
        range.count[a] = last < first ? 0 : last - first + 1;
    }
    return range;
}
/// The same beyond periodic ends, from 0 on.
NATATOR_HD int wrapped(int at, int cells) {
    return at < 0 ? at + cells : at >= cells ? at - cells : at;
}

/// A cell's number as it is nearest to x, where ends are periodic.
NATATOR_HD int nearest_copy(float x, int at, int cells, bool periodic) {
    if (!periodic || cells == 1) return at;
    const float half = 0.5f * static_cast<float>(cells), d = static_cast<float>(at) - x;
    return d > half ? at - cells : d < -half ? at + cells : at;
}

/// The cell that population i streams to from this one (physics/lattice.h), inside periodic ends. False if that is this
/// one or beyond a wall.
NATATOR_HD bool neighbour(int i, const int (&here)[3], const int (&cells)[3], const bool (&periodic)[3], int (&to)[3]) {
    bool inside = i != physics::lattice_populations / 2;
    for (int a = 0; a < 3; ++a) {
        to[a] = here[a] + physics::along(i, a);
        if (periodic[a]) to[a] = wrapped(to[a], cells[a]);
        inside = inside && to[a] >= 0 && to[a] < cells[a];
    }
    return inside;
}
/// By what neighbours share: 4 a face, 2 an edge, 1 a corner, as the weights of a D3Q27 lattice are to each other.
NATATOR_HD float neighbour_weight(int i) {
    const int shared = (i % 3 == 1) + (i / 3 % 3 == 1) + (i / 9 == 1);
    return shared == 2 ? 4.0f : shared == 1 ? 2.0f : 1.0f;
}

/// The body's share of what the water of a cell that it comes to cover has more than it; the rest goes to the water
/// beside. The surface then goes through the cell's centre: half of its water is still outside. With no share less
/// friction acts where bodies cross cells, with all of it more, so that their speed depends on the current
/// (tests/native/lattice_water_test.cpp, results/schools).
constexpr float covered_share = 0.5f;

/// Not fused on a GPU, which so finds the same cells in the same cubes as the CPU.
NATATOR_HD float scalar_product(const float* a, const float (&b)[3]) {
#if defined(__CUDA_ARCH__)
    return __fadd_rn(__fadd_rn(__fmul_rn(a[0], b[0]), __fmul_rn(a[1], b[1])), __fmul_rn(a[2], b[2]));
#else
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
#endif
}

/// xi of a cell's centre, and how far out it is: the greatest |xi|, of a round one the square of xi.
struct PlaceInCube {
    float xi[3];
    float out;
};
NATATOR_HD PlaceInCube place_in(const Cube& cube, int x, int y, int z) {
    const float d[3] = {static_cast<float>(x) - cube.x[0], static_cast<float>(y) - cube.x[1],
                        static_cast<float>(z) - cube.x[2]};
    PlaceInCube place{};
    for (int a = 0; a < 3; ++a) {
        place.xi[a] = scalar_product(cube.to_rest + 3 * a, d);
        const float size = place.xi[a] < 0 ? -place.xi[a] : place.xi[a];
        if (size > place.out) place.out = size;
    }
    if (cube.round) place.out = scalar_product(place.xi, place.xi);
    return place;
}

struct Velocity3 {
    float x, y, z;
};
NATATOR_HD Velocity3 velocity_in(const Cube& cube, const float (&xi)[3]) {
    const float* r = cube.rate;
    return {cube.v[0] + r[0] * xi[0] + r[1] * xi[1] + r[2] * xi[2],
            cube.v[1] + r[3] * xi[0] + r[4] * xi[1] + r[5] * xi[2],
            cube.v[2] + r[6] * xi[0] + r[7] * xi[1] + r[8] * xi[2]};
}
/// Of the cube's motion, 1/step.
NATATOR_HD float divergence_of(const Cube& cube) {
    float sum = 0;
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) sum += cube.rate[3 * a + b] * cube.to_rest[3 * b + a];
    return sum;
}

}  // namespace natator::lattice
