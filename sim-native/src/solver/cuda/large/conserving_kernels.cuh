#pragma once

// Scheme conserving for a large State: a kernel per stage; what acts on solids is done by one block.
#include "flex_kernels.cuh"
#include "solver/cuda/conserving.cuh"

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
        if (s < model.fluid) slots.lambda_sum()[s] = 0;
    }
    for (int k = first; k < model.solids; k += step) slots.internal()[k] = zero;
    for (int k = first; k < model.springs; k += step) slots.spring_lambda()[k] = 0;
    for (int k = first; k < model.members; k += step) slots.member_displacement()[k] = zero;
}

inline constexpr unsigned dropped = 0xffffffff;

/// Marks, where lists are full, the neighbours that do not have the slot in their own list. As keep_mutual_neighbours.
template <class Real>
__global__ void __launch_bounds__(large_threads)
    mark_one_sided(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    const int s = own_index();
    if (s >= model.fluid || !slots.shared().full || slots.failed()) return;
    for (int k = 0; k < slots.neighbour_count()[s]; ++k) {
        const auto other = static_cast<int>(slots.neighbour_entry(s, k));
        if (slots.neighbour_count()[other] != model.most_neighbours) continue;
        bool mutual = false;
        for (int e = 0; e < model.most_neighbours && !mutual; ++e)
            mutual = slots.neighbour_entry(other, e) == static_cast<unsigned>(s);
        if (!mutual) slots.neighbour_entry(s, k) = dropped;
    }
}

template <class Real>
__global__ void __launch_bounds__(large_threads)
    drop_marked(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    const int s = own_index();
    if (s >= model.fluid || !slots.shared().full || slots.failed()) return;
    const int count = slots.neighbour_count()[s];
    int kept = 0;
    for (int k = 0; k < count; ++k) {
        const unsigned other = slots.neighbour_entry(s, k);
        if (other != dropped) slots.neighbour_entry(s, kept++) = other;
    }
    slots.neighbour_count()[s] = kept;
    for (; kept % 4 != 0; ++kept) slots.neighbour_entry(s, kept) = static_cast<unsigned>(model.particles);
}

template <class Real>
__device__ Slots<Real> with_overlap(const Slots<Real>& slots) {
    Slots<Real> own = slots;
    own.overlapping = slots.shared().overlapping != 0;
    return own;
}

template <class Real>
__global__ void __launch_bounds__(large_threads)
    lambda_large(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    if (slots.failed()) return;
    const Slots<Real> own = with_overlap(slots);
    if (compute_lambda(model, own)) slots.shared().high = 1;
}

/// After the first lambdas of a substep: looks for particles that began it overlapping where some density is high.
template <class Real>
__global__ void __launch_bounds__(large_threads)
    find_overlap_large(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    const int s = own_index();
    if (s >= model.fluid || !slots.shared().high || slots.failed()) return;
    if (note_overlap(model, slots, s)) slots.shared().overlapping = 1;
}

/// The first lambdas once more, where particles overlap. Every thread has one slot, the same in both of its parts.
template <class Real>
__global__ void __launch_bounds__(large_threads)
    limit_lambda_large(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    if (!slots.shared().overlapping || slots.failed()) return;
    if (own_index() < model.fluid) slots.lambda_sum()[own_index()] = 0;
    const Slots<Real> own = with_overlap(slots);
    compute_lambda(model, own);
}

/// Pressure on what has contacts.
template <class Real>
__global__ void __launch_bounds__(large_threads)
    touched_pressure_large(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    if (slots.failed()) return;
    if (model.plan.solid_pressure)
        for_each_unit(slots, touched_units<Real>(model, slots),
                      [&](int unit) { push_solids_by_pressure(model, slots, unit); });
    for (int t = own_index(); t < slots.shared().touched; t += static_cast<int>(gridDim.x * blockDim.x))
        if (slots.touched()[t] < model.fluid) push_fluid_by_pressure(model, slots, slots.touched()[t]);
}

/// Pressure, and planes at once, on the fluid that has no contacts: nothing of other slots comes between.
template <class Real>
__global__ void __launch_bounds__(large_threads)
    free_pressure_large(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    const int s = own_index();
    if (s >= model.fluid || slots.failed() || (model.plan.contacts && slots.contact_count()[s] > 0)) return;
    push_fluid_by_pressure(model, slots, s);
    solve_planes_of(model, slots, s);
}

/// Contacts, springs and clusters, by one block.
template <class Real>
__device__ void solve_bodies(const ModelView<Real>& model, const Slots<Real>& slots) {
    if (model.plan.contacts) solve_contacts(model, slots);
    if (model.plan.springs) solve_springs(model, slots);
    if (model.plan.clusters) solve_clusters(model, slots);
}

/// Contacts, springs, clusters, and planes of what is left. One block.
template <class Real>
__global__ void __launch_bounds__(threads)
    solids_large(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    if (slots.failed()) return;
    solve_bodies(model, slots);
    const int touched = model.plan.contacts ? slots.shared().touched : 0;
    for (int t = threadIdx.x; t < touched; t += threads)
        if (slots.touched()[t] < model.fluid) solve_planes_of(model, slots, slots.touched()[t]);
    for (int s = model.fluid + threadIdx.x; s < model.particles; s += threads) solve_planes_of(model, slots, s);
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
    rate_lambda_large(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    if (!slots.failed()) compute_rate_lambda(model, slots);
}

template <class Real>
__global__ void __launch_bounds__(large_threads)
    rate_push_large(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    if (!slots.failed()) push_by_rate_lambda(model, slots);
}

template <class Real>
__global__ void __launch_bounds__(large_threads)
    velocities_in_turn_large(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    const int s = own_index();
    if (s < model.particles && !slots.failed()) commit_large(slots, s, velocity_in_turn(model, slots, s));
}

}  // namespace natator::cuda
