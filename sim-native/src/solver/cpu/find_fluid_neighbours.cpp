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

/// More distances than fit into a processor's cache are dearer to fetch than to compute.
constexpr std::size_t max_distances = 1 << 20;

/// Lists for each fluid particle the fluid particles closer than the radius plus margin at the predicted positions,
/// in the order of their slots per run of cells, at most max_neighbours_. Pairs at distance 0 are left out.
template <class Real>
void Substep<Real>::find_fluid_neighbours() {
    const auto cell_of = [this](int slot) { return slot < ws_.fluid ? ws_.cell_of[ws_.particle_of[slot]] : -1; };
    const auto go_to = [this](Surroundings<Real>& around, int cell) {
        around.go_to(ws_.grid, cell, ws_.fluid_cell_begin);
    };
    const auto choose = [this](int slot, std::int32_t* found, int n) {
        if (!plan_.uniform_fluid) {
            const int i = ws_.particle_of[slot];
            const auto unfelt = [&](int j) { return !collides(i, ws_.particle_of[j]); };
            n = static_cast<int>(std::remove_if(found, found + n, unfelt) - found);
        }
        return std::min(n, max_neighbours_);
    };
    const std::size_t size =
        lists_.list({.position = {ws_.position.x.data(), ws_.position.y.data(), ws_.position.z.data()},
                     .blocks = ws_.blocks(),
                     .distance_squared = constants_.search_distance * constants_.search_distance,
                     .filler = ws_.slots,
                     .min_part = min_part,
                     .kernels = neighbour_kernels_},
                    *team_, {ws_.row_begin, ws_.neighbour, ws_.neighbour_count}, cell_of, go_to, choose);
    const bool keep = size <= max_distances;
    ws_.distance.resize(keep ? std::max(size, ws_.distance.size()) : 0);
}

template FluidView<float> Substep<float>::fluid_view();
template FluidView<double> Substep<double>::fluid_view();
template void Substep<float>::find_fluid_neighbours();
template void Substep<double>::find_fluid_neighbours();

}  // namespace natator::cpu
