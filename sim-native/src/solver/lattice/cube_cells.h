#pragma once

#include "immersed.h"
#include "physics/number.h"

namespace natator::lattice {

/// A box of cells, those outside the lattice left out.
struct CellRange {
    int low[3], count[3];
    NATATOR_HD int size() const { return count[0] * count[1] * count[2]; }
};

NATATOR_HD CellRange cells_between(const float (&lows)[3], const float (&highs)[3], const int (&cells)[3]) {
    CellRange range;
    for (int a = 0; a < 3; ++a) {
        const float low = lows[a], high = highs[a];
        range.low[a] = low < 0 ? 0 : low > static_cast<float>(cells[a]) ? cells[a] : static_cast<int>(low);
        int last = high < 0 ? -1 : high > static_cast<float>(cells[a]) ? cells[a] - 1 : static_cast<int>(high);
        if (last > cells[a] - 1) last = cells[a] - 1;
        range.count[a] = last < range.low[a] ? 0 : last - range.low[a] + 1;
    }
    return range;
}
NATATOR_HD CellRange cells_around(const Cube& cube, const int (&cells)[3]) {
    float low[3], high[3];
    for (int a = 0; a < 3; ++a) low[a] = cube.x[a] - cube.reach[a], high[a] = cube.x[a] + cube.reach[a];
    return cells_between(low, high, cells);
}

/// Not fused on a GPU, which so finds the same cells in the same cubes as the CPU.
NATATOR_HD float scalar_product(const float* a, const float (&b)[3]) {
#if defined(__CUDA_ARCH__)
    return __fadd_rn(__fadd_rn(__fmul_rn(a[0], b[0]), __fmul_rn(a[1], b[1])), __fmul_rn(a[2], b[2]));
#else
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
#endif
}

/// xi of a cell's centre, and how far out it is: the greatest |xi|.
struct PlaceInCube {
    float xi[3];
    float out;
};
NATATOR_HD PlaceInCube place_in(const Cube& cube, int x, int y, int z) {
    const float d[3] = {static_cast<float>(x) - cube.x[0], static_cast<float>(y) - cube.x[1], static_cast<float>(z) - cube.x[2]};
    PlaceInCube place{};
    for (int a = 0; a < 3; ++a) {
        place.xi[a] = scalar_product(cube.to_rest + 3 * a, d);
        const float size = place.xi[a] < 0 ? -place.xi[a] : place.xi[a];
        if (size > place.out) place.out = size;
    }
    return place;
}

/// Cubes that meet overlap by this, so that rounding leaves no gaps between them.
constexpr float cube_edge = 1.02f;

struct Velocity3 {
    float x, y, z;
};
NATATOR_HD Velocity3 velocity_in(const Cube& cube, const float (&xi)[3]) {
    const float* r = cube.rate;
    return {cube.v[0] + r[0] * xi[0] + r[1] * xi[1] + r[2] * xi[2], cube.v[1] + r[3] * xi[0] + r[4] * xi[1] + r[5] * xi[2],
            cube.v[2] + r[6] * xi[0] + r[7] * xi[1] + r[8] * xi[2]};
}
/// (u . grad) u of the cube's motion where its velocity is u, cells/step^2.
NATATOR_HD Velocity3 advected_in(const Cube& cube, const Velocity3& u) {
    const float *t = cube.to_rest, *r = cube.rate;
    const float a = t[0] * u.x + t[1] * u.y + t[2] * u.z, b = t[3] * u.x + t[4] * u.y + t[5] * u.z,
                c = t[6] * u.x + t[7] * u.y + t[8] * u.z;
    return {r[0] * a + r[1] * b + r[2] * c, r[3] * a + r[4] * b + r[5] * c, r[6] * a + r[7] * b + r[8] * c};
}
/// Of the cube's motion, 1/step.
NATATOR_HD float divergence_of(const Cube& cube) {
    float sum = 0;
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) sum += cube.rate[3 * a + b] * cube.to_rest[3 * b + a];
    return sum;
}

}  // namespace natator::lattice
