#pragma once

// Water and its ghosts sorted by the cells of a grid, for the searches of scheme conserving.
#include "water_ghosts.cuh"

namespace natator::cuda {

/// Wraps water that has left a periodic tank, puts what is behind planes before them, and counts particles and ghosts
/// by cell.
template <class Real>
__device__ void begin_water(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    if (s == 0) slots.shared().high = slots.shared().rows = 0;
    const WaterArrays<Real>& water = slots.water;
    const Vec4<Real> before = slots.arrays.state_velocity[s];
    const int number = number_in(before.w);
    const bool fluid = number < model.fluid;
    Vec4<Real> x = slots.arrays.state_position[s];
    if (x.w > 0) {
        const Vec3<Real> there = fluid ? wrapped_water(model.water, xyz(x)) : xyz(x);
        x = quad(put_before_planes(model, there, wall_distance(model, fluid)), x.w);
        slots.arrays.state_position[s] = x;
    }
    const Vec3<Real> in_tank = place_in_tank(model.water, xyz(x));
    water.position[s] = quad(in_tank, model.water.volume[number]);
    water.velocity[s] = quad(xyz(before), x.w);
    if (!fluid) water.slot_of_solid[number - model.fluid] = s;
    for_each_copy(model, in_tank,
                  [&](unsigned, const Vec3<Real>& at) { atomicAdd(water.table + model.water.grid.cell(at), 1); });
}

/// Puts the particles and ghosts of each cell together, in no order. Turns the cells' begins in the table into their
/// ends.
template <class Real>
__device__ void scatter_water(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const auto number = static_cast<std::uint64_t>(number_in(slots.arrays.state_velocity[s].w));
    for_each_copy(model, xyz(water.position[s]), [&](unsigned boundaries, const Vec3<Real>& at) {
        const int place = atomicAdd(water.table + model.water.grid.cell(at), 1);
        if (place < slots.water_room.copies)
            water.keys[place] = static_cast<std::uint64_t>(boundaries) << 58 | number << 32 | static_cast<unsigned>(s);
    });
}

/// Lays out what searches read, in each cell by set of boundaries and then by particle: the order depends on positions
/// alone. Where there is no room for all, it notes how much they need.
template <class Real>
__device__ void order_water(const ModelView<Real>& model, const Slots<Real>& slots) {
    const WaterArrays<Real>& water = slots.water;
    const int all = water.table[model.water.grid.cells - 1], copies = min(all, slots.water_room.copies);
    if (own_index() == 0 && copies < all) slots.shared().needed.copies = all;
    for (int k = own_index(); k < copies; k += static_cast<int>(gridDim.x * blockDim.x)) {
        const std::uint64_t key = water.keys[k];
        const auto boundaries = static_cast<unsigned>(key >> 58), slot = static_cast<unsigned>(key);
        const Vec3<Real> x = ghost_position(model.water, xyz(water.position[slot]), boundaries);
        const int cell = model.water.grid.cell(x);
        const int begin = cell > 0 ? water.table[cell - 1] : 0, end = min(water.table[cell], copies);
        int rank = begin;
        for (int other = begin; other < end; ++other) rank += water.keys[other] < key;
        water.candidate[rank] = quad(x, as_number<Real>(static_cast<int>(boundaries << max_slot_bits | slot)));
    }
}

}  // namespace natator::cuda
