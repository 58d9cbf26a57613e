#pragma once

// Scheme conserving but for its water: a kernel per stage; what acts on solids is done by one block of threads.
#include "body_momentum.cuh"
#include "flex_kernels.cuh"
#include "solids.cuh"

namespace natator::cuda {

template <class Real>
__device__ void begin_large(const ModelView<Real>& model, const Slots<Real>& slots) {
    const Quad<Real> zero{0, 0, 0, 0};
    const int first = own_index(), step = static_cast<int>(gridDim.x * blockDim.x);
    for (int s = first; s < model.particles; s += step) {
        slots.displacement()[s] = zero;
        slots.constraint_count()[s] = 0;
    }
    for (int k = first; k < model.solids; k += step) slots.internal()[k] = zero;
    for (int k = first; k < model.springs; k += step) slots.spring_lambda()[k] = 0;
    for (int k = first; k < model.members; k += step) slots.member_displacement()[k] = zero;
}

/// Contacts, springs, clusters and planes of the solids, in all their iterations; tells the water how they move by then.
/// One block.
template <class Real>
__device__ void solids_large(const ModelView<Real>& model, const Slots<Real>& slots) {
    for (int k = 0; k < model.solid_iterations; ++k) {
        if (model.plan.contacts) solve_contacts(model, slots);
        if (model.plan.springs) solve_springs(model, slots);
        if (model.plan.clusters) solve_clusters(model, slots);
        for (int solid = threadIdx.x; solid < model.solids; solid += slots.size())
            solve_planes_of(model, slots, slots.slot_of_solid()[solid]);
        __syncthreads();
    }
    if (!model.plan.water) return;
    for (int solid = threadIdx.x; solid < model.solids; solid += slots.size())
        slots.water.velocity[slots.water.slot_of_solid[solid]] =
            constrained_velocity<Real>(slots, slots.slot_of_solid()[solid]);
}

template <class Real>
__device__ void constrained_velocities(const ModelView<Real>&, const Slots<Real>& slots, int s) {
    slots.next()[s] = constrained_velocity<Real>(slots, s);
}

template <class Real>
__device__ void velocities_in_turn_large(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    commit_large(slots, s, velocity_in_turn(model, slots, s));
}

}  // namespace natator::cuda
