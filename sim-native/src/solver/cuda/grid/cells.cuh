#pragma once

#include "kernels.cuh"

namespace natator::cuda {

/// Puts what starts behind a plane, or nearer to one than `distance`, there: see physics::put_before.
template <class Real>
__device__ Vec3<Real> put_before_planes(const ModelView<Real>& model, Vec3<Real> x, Real distance) {
    for (int k = 0; k < model.planes; ++k) x = put_before(model.plane[k].surface, distance, x);
    return x;
}

/// v* = v + h g, |v*| <= max_speed, x* = x + h v*; counts the particles of each cell, the fluid's first.
template <Scheme scheme, class Real>
__device__ void predict_on_grid(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    Vec4<Real> x = slots.arrays.state_position[s];
    const Vec4<Real> before = slots.arrays.state_velocity[s];
    const bool fluid = number_in(before.w) < model.fluid;
    if (scheme == Scheme::conserving && x.w > 0) {
        x = quad(put_before_planes(model, xyz(x), model.collision_distance), x.w);
        slots.arrays.state_position[s] = x;
    }
    const Vec3<Real> v = predicted_velocity(model, xyz(before), x.w, fluid, slots.h);
    const Vec3<Real> there = xyz(x) + slots.h * v;
    const int cell = model.grid.cell(there) + (fluid ? 0 : model.grid.cells);
    slots.arrays.unsorted_position[s] = quad(there, x.w);
    slots.arrays.unsorted_velocity[s] = quad(v, before.w);
    slots.arrays.cell[s] = cell;
    atomicAdd(slots.arrays.table + cell, 1);
}

/// Puts the particles of each cell together, in no order. Turns the cells' begins in the table into their ends.
template <class Real>
__device__ void scatter_into_cells(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const auto number = static_cast<std::uint64_t>(number_in(slots.arrays.unsorted_velocity[s].w));
    slots.arrays.keys[atomicAdd(slots.arrays.table + slots.arrays.cell[s], 1)] =
        number << 32 | static_cast<unsigned>(s);
}

/// Numbers the slots anew: a particle's slot is its rank in its cell by number, so that the order depends on positions
/// alone.
template <class Real>
__device__ void order_in_cells(const ModelView<Real>& model, const Slots<Real>& slots, int k) {
    const StateArrays<Real>& arrays = slots.arrays;
    const std::uint64_t key = arrays.keys[k];
    const int before = static_cast<int>(key & 0xffffffffu), number = static_cast<int>(key >> 32);
    const int cell = arrays.cell[before];
    const int begin = cell > 0 ? arrays.table[cell - 1] : 0, end = arrays.table[cell];
    int s = begin;
    for (int other = begin; other < end; ++other) s += arrays.keys[other] < key;
    const Vec4<Real> there = arrays.unsorted_position[before];
    arrays.start[s] = arrays.state_position[before];
    arrays.predicted_velocity[s] = quad(xyz(arrays.unsorted_velocity[before]), there.w);
    arrays.position[s] = arrays.predicted_position[s] = there;
    arrays.number[s] = number;
    if (model.plan.water) slots.water.slot_before[s] = before;
    if (s >= model.fluid) arrays.slot_of_solid[number - model.fluid] = s;
}

/// The box around the solids, by one block.
template <class Real>
__device__ void prepare_search(const ModelView<Real>& model, const Slots<Real>& slots) {
    if (threadIdx.x < 32) bound_solids(model, slots, slots.position());
    if (threadIdx.x == 0) slots.shared().contact_slot_count = 0;
}

}  // namespace natator::cuda
