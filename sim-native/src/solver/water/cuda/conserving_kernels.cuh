#pragma once

// Scheme conserving but for its water: a kernel per stage; what acts on solids is done by one block of threads.
#include "solver/flex/cuda/flex_kernels.cuh"
#include "solver/solids/cuda/body_momentum.cuh"
#include "solver/solids/cuda/chip_solids.cuh"
#include "solver/solids/cuda/solid_contacts.cuh"

namespace natator::cuda {

template <class Real>
__device__ void begin_on_grid(const ModelView<Real>& model, const Slots<Real>& slots) {
    const Vec4<Real> zero{0, 0, 0, 0};
    const int first = own_index(), step = static_cast<int>(gridDim.x * blockDim.x);
    for (int s = first; s < model.particles; s += step) {
        slots.displacement()[s] = zero;
        slots.constraint_count()[s] = 0;
    }
    for (int k = first; k < model.solids; k += step) slots.internal()[k] = zero;
    for (int k = first; k < model.springs; k += step) slots.spring_lambda()[k] = 0;
    for (int k = first; k < model.members; k += step) slots.member_displacement()[k] = zero;
}

/// Tells the water how the solids move. Each thread its own.
template <class Real>
__device__ void send_velocities_to_water(const ModelView<Real>& model, const Slots<Real>& slots) {
    if (!model.plan.water) return;
    for_each_in_block(model.solids, [&](int solid) {
        slots.water.velocity[slots.water.slot_of_solid[solid]] =
            constrained_velocity<Real>(slots, slots.slot_of_solid()[solid]);
    });
}

/// Contacts, springs, clusters and planes of the solids, in all their iterations; tells the water how they move by
/// then. One block.
template <class Real>
__device__ void solids_in_memory(const ModelView<Real>& model, const Slots<Real>& slots) {
    iterate_solids(model, SolidsInMemory<Real>(model, slots), slots.h, [&] {
        if (model.plan.contacts) solve_contacts(model, slots);
    });
    send_velocities_to_water(model, slots);
}

/// The same without contacts.
template <class Real>
__device__ void solids_on_chip(const ModelView<Real>& model, const Slots<Real>& slots, const SolidLayout& layout) {
    extern __shared__ __align__(128) char chip_memory[];
    const SolidsInMemory<Real> memory(model, slots);
    const SolidsOnChip<Real> chip(layout, chip_memory);
    load_on_chip(model, memory, chip);
    iterate_solids(model, chip, slots.h, [] {});
    store_from_chip(model, chip, memory);
    send_velocities_to_water(model, slots);
}

template <class Real>
__device__ void constrained_velocities(const ModelView<Real>&, const Slots<Real>& slots, int s) {
    slots.scratch_position()[s] = constrained_velocity<Real>(slots, s);
}

template <class Real>
__device__ void final_velocities_on_grid(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    commit_on_grid(slots, s, final_velocity(model, slots, s));
}

}  // namespace natator::cuda
