#include "tank_ends.h"

#include <cmath>

namespace natator {
namespace {

constexpr double square = 1e-9;  // 1 - |cosine| of what stands across an axis

}  // namespace

const char* name_of_axis(int axis) {
    return axis == 0 ? "x" : "z";
}

bool is_across(const Plane& plane, int axis) {
    return std::abs(plane.normal[axis]) > 1 - square;
}

TankEnds tank_ends(const std::vector<Plane>& planes, int axis) {
    TankEnds ends;
    for (const Plane& plane : planes) {
        if (!is_across(plane, axis)) continue;
        if (plane.normal[axis] > 0)
            ends.low.push_back(0 - plane.offset);  // not -0
        else
            ends.high.push_back(plane.offset);
    }
    return ends;
}

std::string one_each_needed(const TankEnds& ends, int axis) {
    return std::string("needs one plane at each end of the tank along ") + name_of_axis(axis) + ", found " +
           std::to_string(ends.low.size()) + " at the low end and " + std::to_string(ends.high.size()) +
           " at the high end";
}

}  // namespace natator
