#include <algorithm>

#include "substep.h"

namespace natator::cpu {

template <class Real>
FluidView<Real> Substep<Real>::fluid_view() {
    const auto position = ws_.position.pointers();
    const auto correction = ws_.correction.pointers();
    const auto velocity = ws_.velocity.pointers();
    return {.first_block = 0,
            .end_block = ws_.blocks(),
            .row_begin = ws_.row_begin.data(),
            .neighbour = ws_.neighbour.data(),
            .far_slot = ws_.slots,
            .radius = constants_.radius,
            .inverse_radius = constants_.inverse_radius,
            .density_scale = constants_.density_scale,
            .position = {position[0], position[1], position[2]},
            .inverse_mass = ws_.inverse_mass.data(),
            .solid_density = ws_.solid_density.data(),
            .density = ws_.density.data(),
            .compression = ws_.compression.data(),
            .correction = {correction[0], correction[1], correction[2]},
            .constraint_count = ws_.constraint_count.data(),
            .velocity = {velocity[0], velocity[1], velocity[2]},
            .velocity_change = {correction[0], correction[1], correction[2]},
            .packed = ws_.packed.data(),
            .packed_velocity = ws_.packed_velocity.data(),
            .distance = ws_.distance.empty() ? nullptr : ws_.distance.data()};
}

/// Lists for each fluid particle the fluid particles closer than the radius plus margin at the predicted positions,
/// in the order of their slots per run of cells, at most most_neighbours_. Pairs at distance 0 are left out.
/// Writes the rows of these blocks to the front of `rows`; row_begin counts from there.
template <class Real>
void Substep<Real>::list_fluid_neighbours(int first_block, int end_block, ListRoom& room,
                                          AlignedVector<std::int32_t>& all_rows) {
    const Real* const position[3] = {ws_.position.x.data(), ws_.position.y.data(), ws_.position.z.data()};
    const Real distance_squared = constants_.search_distance * constants_.search_distance;
    int row = -1;
    typename CellGrid<Real>::Rows rows_around;
    std::size_t end = 0;
    for (int block = first_block; block < end_block; ++block) {
        int rows = 0;
        std::array<int, lanes> count{};
        std::array<const std::int32_t*, lanes> list{};
        for (int lane = 0; lane < lanes; ++lane) {
            const int slot = block * lanes + lane;
            if (slot >= ws_.fluid) continue;
            const int cell = ws_.cell_of[ws_.particle_of[slot]];
            if (ws_.grid.row(cell) != row) {
                row = ws_.grid.row(cell);
                rows_around = ws_.grid.rows_around(row);
            }
            SlotRuns runs;
            const int candidates = add_runs(rows_around, cell, ws_.fluid_cell_begin, runs);
            std::vector<std::int32_t>& found = room.found[lane];
            if (static_cast<int>(found.size()) < candidates + lanes) found.resize(2 * candidates + lanes);
            int n = neighbour_kernels_->find(position, slot, runs, distance_squared, found.data());
            if (!plan_.uniform_fluid) {
                const int i = ws_.particle_of[slot];
                const auto unfelt = [&](int j) { return !collides(i, ws_.particle_of[j]); };
                n = static_cast<int>(std::remove_if(found.begin(), found.begin() + n, unfelt) - found.begin());
            }
            list[lane] = found.data();
            count[lane] = std::min(n, most_neighbours_);
            ws_.neighbour_count[slot] = count[lane];
            rows = std::max(rows, count[lane]);
        }
        const std::size_t needed = end + static_cast<std::size_t>(round_up_to_block(rows)) * lanes;
        if (all_rows.size() < needed) all_rows.resize(needed + needed / 2);
        neighbour_kernels_->interleave(list.data(), count.data(), rows, ws_.slots, all_rows.data() + end);
        ws_.row_begin[block] = static_cast<int>(end / lanes);
        end += static_cast<std::size_t>(rows) * lanes;
    }
    room.size = end;
}

/// More distances than fit into a processor's cache are dearer to fetch than to compute.
constexpr std::size_t most_distances = 1 << 20;

/// The first part of the blocks has its rows written in place, the others into room of their own, to be appended.
template <class Real>
void Substep<Real>::find_fluid_neighbours() {
    list_room_.resize(team_->most_parts());
    for (ListRoom& room : list_room_) room.size = 0;
    team_->for_parts(ws_.blocks(), shortest_part, [this](int part, int begin, int end) {
        ListRoom& room = list_room_[part];
        list_fluid_neighbours(begin, end, room, part == 0 ? ws_.neighbour : room.rows);
    });
    std::size_t size = 0;
    for (const ListRoom& room : list_room_) size += room.size;
    if (ws_.neighbour.size() < size) ws_.neighbour.resize(size + size / 2);
    team_->for_parts(ws_.blocks(), shortest_part, [this](int part, int begin, int end) {
        std::size_t before = 0;
        for (int k = 0; k < part; ++k) before += list_room_[k].size;
        if (part == 0) return;
        const ListRoom& room = list_room_[part];
        std::copy_n(room.rows.begin(), room.size, ws_.neighbour.begin() + static_cast<std::ptrdiff_t>(before));
        for (int block = begin; block < end; ++block) ws_.row_begin[block] += static_cast<int>(before / lanes);
    });
    ws_.row_begin[ws_.blocks()] = static_cast<int>(size / lanes);
    const bool keep = size <= most_distances;
    ws_.distance.resize(keep ? std::max(size, ws_.distance.size()) : 0);
}

template FluidView<float> Substep<float>::fluid_view();
template FluidView<double> Substep<double>::fluid_view();
template void Substep<float>::find_fluid_neighbours();
template void Substep<double>::find_fluid_neighbours();

}  // namespace natator::cpu
