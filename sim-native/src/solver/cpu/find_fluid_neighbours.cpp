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
            .velocity_change = {correction[0], correction[1], correction[2]}};
}

/// Lists for each fluid particle the fluid particles closer than the radius plus margin at the predicted positions,
/// in the order of their slots per run of cells, at most most_neighbours_. Pairs at distance 0 are left out.
template <class Real>
void Substep<Real>::find_fluid_neighbours() {
    const FluidView<Real> view = fluid_view();
    const Real distance_squared = constants_.search_distance * constants_.search_distance;
    std::array<std::vector<std::int32_t>, lanes>& found = found_;
    ws_.neighbour.clear();
    for (int block = 0; block < ws_.blocks(); ++block) {
        int rows = 0;
        std::array<int, lanes> count{};
        for (int lane = 0; lane < lanes; ++lane) {
            const int slot = block * lanes + lane;
            if (slot >= ws_.fluid) continue;
            std::array<SlotRun, 9> runs;
            int run_count = 0;
            int candidates = 0;
            ws_.grid.for_each_run(ws_.position.x[slot], ws_.position.y[slot], ws_.position.z[slot],
                                  [&](int first, int last) {
                                      const SlotRun run{ws_.fluid_cell_begin[first], ws_.fluid_cell_begin[last + 1]};
                                      if (run.begin == run.end) return;
                                      candidates += run.end - run.begin;
                                      runs[run_count++] = run;
                                  });
            if (static_cast<int>(found[lane].size()) <= candidates) found[lane].resize(2 * candidates + lanes);
            std::int32_t* const list = found[lane].data();
            int n = kernels_->append_neighbours(view, slot, runs.data(), run_count, distance_squared, list);
            if (!plan_.uniform_fluid) {
                const int i = ws_.particle_of[slot];
                n = static_cast<int>(
                    std::remove_if(list, list + n, [&](int j) { return !collides(i, ws_.particle_of[j]); }) - list);
            }
            count[lane] = std::min(n, most_neighbours_);
            ws_.neighbour_count[slot] = count[lane];
            rows = std::max(rows, count[lane]);
        }
        const std::size_t begin = ws_.neighbour.size();
        ws_.row_begin[block] = static_cast<int>(begin / lanes);
        ws_.neighbour.resize(begin + static_cast<std::size_t>(rows) * lanes);
        for (int lane = 0; lane < lanes; ++lane) {
            std::int32_t* entry = ws_.neighbour.data() + begin + lane;
            for (int row = 0; row < rows; ++row, entry += lanes)
                *entry = row < count[lane] ? found[lane][row] : ws_.slots;
        }
    }
    ws_.row_begin[ws_.blocks()] = static_cast<int>(ws_.neighbour.size() / lanes);
}

template FluidView<float> Substep<float>::fluid_view();
template FluidView<double> Substep<double>::fluid_view();
template void Substep<float>::find_fluid_neighbours();
template void Substep<double>::find_fluid_neighbours();

}  // namespace natator::cpu
