#include <algorithm>
#include <utility>

#include "bounding_box.h"
#include "substep.h"

namespace natator::cpu {

/// Counting sort of the particles `ids` by cell, stable: numbers their slots from `first_slot` on. Each part of the
/// particles counts for itself and knows then where in every cell its own begin.
template <class Real>
void Substep<Real>::sort_by_cell(const std::vector<int>& ids, int first_slot, std::vector<int>& cell_begin) {
    const int count = static_cast<int>(ids.size());
    const int grain = std::max(min_part * lanes, (count + team_->size() - 1) / team_->size());
    next_slot_.resize(team_->size());
    for (std::vector<int>& next : next_slot_) next.clear();
    team_->for_parts(count, grain, [&](int part, int begin, int end) {
        std::vector<int>& counts = next_slot_[part];
        counts.assign(ws_.grid.cells(), 0);
        for (int k = begin; k < end; ++k) ++counts[ws_.cell_of[ids[k]]];
    });
    cell_begin.resize(ws_.grid.cells() + 1);
    int next = first_slot;
    for (int cell = 0; cell < ws_.grid.cells(); ++cell) {
        cell_begin[cell] = next;
        for (std::vector<int>& counts : next_slot_)
            if (!counts.empty()) next += std::exchange(counts[cell], next);
    }
    cell_begin.back() = next;
    team_->for_parts(count, grain, [&](int part, int begin, int end) {
        std::vector<int>& next_of = next_slot_[part];
        for (int k = begin; k < end; ++k) {
            const int slot = next_of[ws_.cell_of[ids[k]]]++;
            ws_.slot_of[ids[k]] = slot;
            ws_.particle_of[slot] = ids[k];
        }
    });
}

template <class Real>
void Substep<Real>::number_slots() {
    const auto& position = ws_.unsorted_position;
    const Box<Real> box = bounding_box(position, *team_);
    ws_.grid.cover(box.low, box.high, constants_.search_distance, 4096 + 16 * ws_.particles);
    team_->for_each(ws_.particles, min_part * lanes,
                    [&](int i) { ws_.cell_of[i] = ws_.grid.cell(position[i].x(), position[i].y(), position[i].z()); });
    sort_by_cell(ws_.fluid_ids, 0, ws_.fluid_cell_begin);
    sort_by_cell(ws_.solid_ids, ws_.solid_begin, ws_.solid_cell_begin);
}

template void Substep<float>::number_slots();
template void Substep<double>::number_slots();

}  // namespace natator::cpu
