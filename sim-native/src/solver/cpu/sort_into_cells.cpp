#include <algorithm>

#include "substep.h"

namespace natator::cpu {
namespace {

/// Counting sort of the particles `ids` by cell, stable: numbers their slots from `first_slot` on.
template <class Real>
void sort_by_cell(Workspace<Real>& ws, const std::vector<int>& ids, int first_slot, std::vector<int>& cell_begin) {
    cell_begin.assign(ws.grid.cells() + 1, 0);
    for (const int i : ids) ++cell_begin[ws.cell_of[i]];
    int next = first_slot;
    for (int& begin : cell_begin) {
        const int count = begin;
        begin = next;
        next += count;
    }
    for (const int i : ids) {
        const int slot = cell_begin[ws.cell_of[i]]++;
        ws.slot_of[i] = slot;
        ws.particle_of[slot] = i;
    }
    // Each entry has moved on to its cell's end, which is where the next cell begins.
    std::copy_backward(cell_begin.begin(), cell_begin.end() - 1, cell_begin.end());
    cell_begin.front() = first_slot;
}

}  // namespace

template <class Real>
void Substep<Real>::sort_into_cells() {
    std::array<Real, 3> low, high;
    const auto& position = ws_.predicted_position;
    for (int axis = 0; axis < 3; ++axis) low[axis] = high[axis] = position[0][axis];
    for (const Vector3<Real>& x : position)
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], x[axis]);
            high[axis] = std::max(high[axis], x[axis]);
        }
    ws_.grid.cover(low, high, constants_.search_distance, 4096 + 16 * ws_.particles);
    team_->for_parts(ws_.particles, shortest_part * lanes, [&](int, int begin, int end) {
        for (int i = begin; i < end; ++i)
            ws_.cell_of[i] = ws_.grid.cell(position[i].x(), position[i].y(), position[i].z());
    });
    sort_by_cell(ws_, ws_.fluid_ids, 0, ws_.fluid_cell_begin);
    sort_by_cell(ws_, ws_.solid_ids, ws_.solid_begin, ws_.solid_cell_begin);
}

template void Substep<float>::sort_into_cells();
template void Substep<double>::sort_into_cells();

}  // namespace natator::cpu
