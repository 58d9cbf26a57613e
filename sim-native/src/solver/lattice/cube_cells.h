#pragma once

#include "immersed.h"
#include "physics/number.h"

namespace natator::lattice {

/// Cells around a cube. Those beyond walls are left out; those beyond periodic ends count on.
struct CellRange {
    int low[3], count[3];
    NATATOR_HD int size() const { return count[0] * count[1] * count[2]; }
};

NATATOR_HD CellRange cells_around(const Cube& cube, const int (&cells)[3], const bool (&periodic)[3]) {
    CellRange range;
    for (int a = 0; a < 3; ++a) {
        const float n = static_cast<float>(cells[a]), margin = periodic[a] ? n : 0;
        const auto within = [&](float at) { return static_cast<int>(at < -margin ? -margin : at > n + margin ? n + margin : at); };
        const float low = cube.x[a] - cube.reach[a], high = cube.x[a] + cube.reach[a];
        int first = within(low), last = high < -margin ? -1 - static_cast<int>(margin) : within(high);
        if (static_cast<float>(first) < low) ++first;
        if (static_cast<float>(last) > high) --last;
        if (!periodic[a] && last > cells[a] - 1) last = cells[a] - 1;
        range.low[a] = first;
        range.count[a] = last < first ? 0 : last - first + 1;
    }
    return range;
}
/// Its number from 0 on.
NATATOR_HD int wrapped(int at, int cells) {
    const int rest = at % cells;
    return rest < 0 ? rest + cells : rest;
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
        const float* row = cube.to_rest + 3 * a;
        place.xi[a] = row[0] * d[0] + row[1] * d[1] + row[2] * d[2];
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
/// Of the cube's motion, 1/step.
NATATOR_HD float divergence_of(const Cube& cube) {
    float sum = 0;
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) sum += cube.rate[3 * a + b] * cube.to_rest[3 * b + a];
    return sum;
}

}  // namespace natator::lattice
