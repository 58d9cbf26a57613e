#pragma once

// Scheme conserving but for its water: a kernel per stage; what acts on solids is done by one block.
#include "body_momentum.cuh"
#include "flex_kernels.cuh"
#include "solids.cuh"

namespace natator::cuda {

template <class Real>
__global__ void __launch_bounds__(large_threads)
    begin_large(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    const Quad<Real> zero{0, 0, 0, 0};
    const int first = own_index(), step = static_cast<int>(gridDim.x * blockDim.x);
    for (int s = first; s < model.particles; s += step) {
        slots.displacement()[s] = zero;
        slots.active()[s] = 0;
    }
    for (int k = first; k < model.solids; k += step) slots.internal()[k] = zero;
    for (int k = first; k < model.springs; k += step) slots.spring_lambda()[k] = 0;
    for (int k = first; k < model.members; k += step) slots.member_displacement()[k] = zero;
}

/// Contacts, springs, clusters and planes of the solids; tells the water how they move by then. One block.
template <class Real>
__global__ void __launch_bounds__(threads)
    solids_large(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    if (slots.failed()) return;
    if (model.plan.contacts) solve_contacts(model, slots);
    if (model.plan.springs) solve_springs(model, slots);
    if (model.plan.clusters) solve_clusters(model, slots);
    for (int solid = threadIdx.x; solid < model.solids; solid += threads) {
        const int s = slots.slot_of_solid()[solid];
        solve_planes_of(model, slots, s);
        if (model.plan.water)
            slots.water.velocity[slots.water.slot_of_solid[solid]] = constrained_velocity<Real>(slots, s);
    }
}

template <class Real>
__global__ void __launch_bounds__(large_threads)
    constrained_velocities(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    const int s = own_index();
    if (s < model.particles && !slots.failed()) slots.next()[s] = constrained_velocity<Real>(slots, s);
}

/// One block.
template <class Real>
__global__ void __launch_bounds__(threads)
    body_momentum_large(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    if (!slots.failed()) keep_body_momentum(model, slots);
}

template <class Real>
__global__ void __launch_bounds__(large_threads)
    velocities_in_turn_large(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    const int s = own_index();
    if (s < model.particles && !slots.failed()) commit_large(slots, s, velocity_in_turn(model, slots, s));
}

}  // namespace natator::cuda
