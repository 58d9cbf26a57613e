// What the kernels over fluid neighbours share. For kernel sources only, which are compiled once per instruction set:
// everything here is local to the source that includes it.
#pragma once

#include "lanes.h"

namespace natator::cpu::NATATOR_ISA {
namespace {

constexpr int lanes = 16;

[[maybe_unused]] float square_root(float v) {
    return __builtin_sqrtf(v);
}
[[maybe_unused]] double square_root(double v) {
    return __builtin_sqrt(v);
}

/// Keeps 1/r finite at r = 0, where the direction is 0 anyway; too small to change any other r^2.
template <class Real>
constexpr Real tiny = Real(1e-30);

/// From particle j to particle i.
template <class Real>
struct Separation {
    Real x, y, z, r2;
};

/// For the plain loops: calls pair(lane, j, separation) for each entry of a block's rows of neighbours j.
template <class Real, class View, class Pair>
void for_each_neighbour(const View& fluid, int block, const Pair& pair) {
    const Real* const x = fluid.position[0];
    const Real* const y = fluid.position[1];
    const Real* const z = fluid.position[2];
    for (int row = fluid.row_begin[block]; row < fluid.row_begin[block + 1]; ++row) {
        const std::int32_t* const neighbour = fluid.neighbour + row * lanes;
        for (int lane = 0; lane < lanes; ++lane) {
            const int i = block * lanes + lane;
            const int j = neighbour[lane];
            const Real dx = x[i] - x[j];
            const Real dy = y[i] - y[j];
            const Real dz = z[i] - z[j];
            pair(lane, j, Separation<Real>{dx, dy, dz, dx * dx + dy * dy + dz * dz});
        }
    }
}

/// Calls work(first slot, first row, last row, offset in each row) for each group of `width` slots.
template <class View, class Work>
void for_each_group(const View& fluid, const Work& work) {
    for (int block = fluid.first_block; block < fluid.end_block; ++block)
        for (int lane = 0; lane < lanes; lane += width)
            work(block * lanes + lane, fluid.row_begin[block], fluid.row_begin[block + 1], lane);
}

/// Lays three arrays out as quadruples (x, y, z, w), also for the far slot.
template <class View>
void pack_arrays(const View& fluid, const float* const from[3], const float* w, float* to) {
    const auto pack_group = [&](int slot) {
        store_quadruples(to + 4 * slot,
                         {load(from[0] + slot), load(from[1] + slot), load(from[2] + slot), load(w + slot)});
    };
    for (int slot = fluid.first_block * lanes; slot < fluid.end_block * lanes; slot += width) pack_group(slot);
    if (fluid.first_block == 0) pack_group(fluid.far_slot / width * width);
}

}  // namespace
}  // namespace natator::cpu::NATATOR_ISA
