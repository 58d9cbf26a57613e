#include <algorithm>
#include <bit>

#include "substep.h"

namespace natator::cpu {

/// Lists the pairs that are not both fluid and closer than the radius plus margin at the predicted positions, in both
/// directions that collide (a pair of one group may be felt by one side only). Pairs at distance 0 are left out.
template <class Real>
void Substep<Real>::find_contacts() {
    const Real distance_squared = constants_.search_distance * constants_.search_distance;
    const Real* const position[3] = {ws_.position.x.data(), ws_.position.y.data(), ws_.position.z.data()};
    std::vector<std::pair<int, int>>& pairs = pairs_;
    pairs.clear();
    for (int slot = ws_.solid_begin; slot < ws_.slots; ++slot) {
        const int i = ws_.particle_of[slot], cell = ws_.cell_of[i];
        const auto rows = ws_.grid.rows_around(ws_.grid.row(cell));
        SlotRuns runs;
        int candidates = plan_.water ? 0 : add_runs(ws_.grid, rows, cell, ws_.fluid_cell_begin, runs);
        candidates += add_runs(ws_.grid, rows, cell, ws_.solid_cell_begin, runs);
        if (static_cast<int>(found_contacts_.size()) < candidates + lanes)
            found_contacts_.resize(2 * candidates + lanes);
        const int n = neighbour_kernels_->find(position, slot, runs, distance_squared, found_contacts_.data());
        for (int k = 0; k < n; ++k) {
            const int other = found_contacts_[k], j = ws_.particle_of[other];
            const bool mutual = plan_.mutual_contacts && (collides(i, j) || collides(j, i));
            if (mutual || collides(i, j)) pairs.emplace_back(slot, other);
            if (other < ws_.solid_begin && (mutual || collides(j, i))) pairs.emplace_back(other, slot);
        }
    }
    std::sort(pairs.begin(), pairs.end());

    ws_.contact_slots.clear();
    ws_.contact_begin.clear();
    ws_.contact.clear();
    for (const auto& [slot, other] : pairs) {
        if (ws_.contact_slots.empty() || ws_.contact_slots.back() != slot) {
            ws_.contact_slots.push_back(slot);
            ws_.contact_begin.push_back(static_cast<int>(ws_.contact.size()));
        }
        ws_.contact.push_back(other);
    }
    ws_.contact_begin.push_back(static_cast<int>(ws_.contact.size()));
}

/// Lists the planes that each particle is within collision_distance plus margin of, last plane first.
template <class Real>
void Substep<Real>::find_plane_contacts() {
    ws_.plane_groups.clear();
    const NearPlanes<Real> slots = near_planes();
    for (int plane = static_cast<int>(model_.planes.size()) - 1; plane >= 0; --plane) {
        PlaneView<Real> view = plane_view(plane);
        view.distance = constants_.plane_search_distance;
        for (int block = 0; block < ws_.all_blocks(); ++block) {
            const unsigned near = plane_kernels_->near(slots, block, view);
            unsigned chosen = 0;
            for (unsigned rest = near; rest != 0; rest &= rest - 1) {
                const int lane = std::countr_zero(rest), slot = block * lanes + lane;
                if (!(ws_.inverse_mass[slot] > 0)) continue;  // held in place, or no particle's slot
                chosen |= 1u << lane;
            }
            if (chosen != 0) ws_.plane_groups.push_back({plane, block, chosen});
        }
    }
}

template void Substep<float>::find_contacts();
template void Substep<double>::find_contacts();
template void Substep<float>::find_plane_contacts();
template void Substep<double>::find_plane_contacts();

}  // namespace natator::cpu
