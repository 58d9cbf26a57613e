#pragma once

#include <string>
#include <vector>

#include "natator/scene.h"

namespace natator {

/// "x" or "z".
const char* name_of_axis(int axis);

/// Does a plane stand square across an axis, facing its low or its high end?
bool is_across(const Plane& plane, int axis);

/// Where planes stand square across an axis at either end of a tank, length.
struct TankEnds {
    std::vector<double> low, high;

    bool one_each() const { return low.size() == 1 && high.size() == 1; }
    bool none() const { return low.empty() && high.empty(); }
};
TankEnds tank_ends(const std::vector<Plane>& planes, int axis);

/// What to say where there is not one each.
std::string one_each_needed(const TankEnds& ends, int axis);

}  // namespace natator
