#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "natator/model.h"
#include "thread_team.h"

namespace natator::cpu {

template <class Real>
struct Box {
    std::array<Real, 3> low, high;

    void cover(const Box& other) {
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], other.low[axis]);
            high[axis] = std::max(high[axis], other.high[axis]);
        }
    }
};

/// The smallest box with all positions in it; there is at least one.
template <class Real>
Box<Real> bounding_box(const std::vector<Vector3<Real>>& position, ThreadTeam& team) {
    constexpr int min_part = 8192;  // fewer are done before another thread is awake
    const auto around = [](const Vector3<Real>& x) { return Box<Real>{{x[0], x[1], x[2]}, {x[0], x[1], x[2]}}; };
    std::vector<Box<Real>> boxes(team.max_parts(), around(position[0]));
    team.for_parts(static_cast<int>(position.size()), min_part, [&](int part, int begin, int end) {
        Box<Real> box = boxes[part];  // not shared with another thread's cache line
        for (int i = begin; i < end; ++i) box.cover(around(position[i]));
        boxes[part] = box;
    });
    Box<Real> all = boxes[0];
    for (const Box<Real>& box : boxes) all.cover(box);
    return all;
}

}  // namespace natator::cpu
