#pragma once

#include <array>
#include <span>
#include <vector>

#include "exact_grid.h"

namespace natator {

/// The corners of a polygon in the order of the one among all that go round from another corner which comes first by
/// its numbers.
void rotate_to_canonical(std::vector<int>& corners);

/// Numbers of the corners of n - 2 triangles that a polygon of n consists of, with exact signs: by cutting ears
/// (Meisters: Polygons have ears, 1975), then by turning edges until no circle through three corners holds a fourth
/// (Lawson: Software for C1 surface interpolation, 1977). Concave polygons too, and those with corners on straight
/// edges or joined to a hole by an edge that goes both ways. All corners remain corners: other faces have them too. It
/// need not be quite flat; it is seen along the axis that it faces most. Empty if its outline cuts itself. `work`
/// counts the corners that were looked at, and goes no further than `max_work`, where it throws InputError.
///
/// No library does this: those that are small drop corners on straight edges (mapbox/earcut) or cut by rounded numbers
/// (tinyobjloader), which leaves holes between a face and its neighbours.
std::vector<std::array<int, 3>> cut_polygon(std::span<const int> corners, std::span<const GridPoint> points, long& work,
                                            long max_work);

}  // namespace natator
