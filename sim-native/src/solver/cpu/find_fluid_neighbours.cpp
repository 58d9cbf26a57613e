#include <algorithm>

#include "substep.h"

namespace natator::cpu {

template <class Real>
FluidView<Real> Substep<Real>::fluid_view() {
    const auto pointers = [](auto& array) { return std::array{array.x.data(), array.y.data(), array.z.data()}; };
    const auto position = pointers(ws_.position);
    const auto correction = pointers(ws_.correction);
    const auto velocity = pointers(ws_.velocity);
    return {.blocks = ws_.blocks(),
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
            .distance = ws_.distance.data()};
}

/// Lists for each fluid particle the fluid particles closer than the radius plus margin at the predicted positions,
/// in the order of their slots per run of cells, at most most_neighbours_. Pairs at distance 0 are left out.
template <class Real>
void Substep<Real>::find_fluid_neighbours() {
    const Real* const position[3] = {ws_.position.x.data(), ws_.position.y.data(), ws_.position.z.data()};
    const Real distance_squared = constants_.search_distance * constants_.search_distance;
    int row = -1;
    typename CellGrid<Real>::Rows rows_around;
    std::size_t end = 0;
    for (int block = 0; block < ws_.blocks(); ++block) {
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
            std::vector<std::int32_t>& found = found_[lane];
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
        if (ws_.neighbour.size() < needed) ws_.neighbour.resize(needed + needed / 2);
        neighbour_kernels_->interleave(list.data(), count.data(), rows, ws_.slots, ws_.neighbour.data() + end);
        ws_.row_begin[block] = static_cast<int>(end / lanes);
        end += static_cast<std::size_t>(rows) * lanes;
    }
    ws_.row_begin[ws_.blocks()] = static_cast<int>(end / lanes);
    ws_.distance.resize(ws_.neighbour.size());
}

template FluidView<float> Substep<float>::fluid_view();
template FluidView<double> Substep<double>::fluid_view();
template void Substep<float>::find_fluid_neighbours();
template void Substep<double>::find_fluid_neighbours();

}  // namespace natator::cpu
