#pragma once

// Contacts of scheme conserving, by one block of threads, in device memory.
#include "solids.cuh"
#include "solver/cuda/grid/search.cuh"

namespace natator::cuda {

/// Depth of a contact beyond what this substep may leave of it.
template <class Real>
__device__ Real contact_depth(const ModelView<Real>& model, const Slots<Real>& slots, int s, int other) {
    const auto distance = [&](const Vec4<Real>* places) { return norm(xyz(places[s]) - xyz(places[other])); };
    return physics::limited_depth(
        model.solid_rest_distance, distance(slots.position()), model.overlap_acceleration * slots.h * slots.h,
        [&] { return distance(slots.start()); }, [&] { return distance(slots.predicted_position()); });
}

/// Masses are split over the contacts that are not apart. Ends with a barrier.
template <class Real>
__device__ void solve_contacts(const ModelView<Real>& model, const Slots<Real>& slots) {
    const int tasks = contact_task_count<Real>(model, slots);
    for_each_warp_task(slots, tasks, 0, [&](int task) {
        for_each_contact_slot(slots, task, [&](int s, int lane) {
            int active = 0;
            if (s >= 0)
                for_each_contact_of(model, slots, s, lane, pair_lanes,
                                    [&](int other) { active += contact_depth<Real>(model, slots, s, other) > 0; });
            active = sum_of_lanes(active);
            if (s >= 0 && lane == 0) slots.constraint_count()[s] = static_cast<std::uint16_t>(active);
        });
    });
    __syncthreads();
    for_each_warp_task(slots, tasks, 0, [&](int task) {
        for_each_contact_slot(slots, task, [&](int s, int lane) {
            const Real inverse_mass = s >= 0 ? slots.position()[s].w : Real(0);
            const int active = s >= 0 ? slots.constraint_count()[s] : 0;
            Vec3<Real> sum{0, 0, 0};
            if (active > 0 && inverse_mass > 0)
                for_each_contact_of(model, slots, s, lane, pair_lanes, [&](int other) {
                    const Real depth = contact_depth<Real>(model, slots, s, other);
                    if (!(depth > 0)) return;
                    const Real share = physics::split_share(inverse_mass, static_cast<Real>(active),
                                                            partner_weight(model, slots, s, other),
                                                            static_cast<Real>(slots.constraint_count()[other]));
                    sum += share * contact_push(model, slots, s, other, depth);
                });
            const Vec4<Real> push{sum_of_lanes(sum.x), sum_of_lanes(sum.y), sum_of_lanes(sum.z), Real(0)};
            if (s >= 0 && lane == 0) slots.contact_push()[s] = push;
        });
    });
    __syncthreads();
    for (int t = threadIdx.x; t < slots.shared().contact_slot_count; t += slots.size()) {
        const int s = slots.contact_slots()[t];
        if (slots.constraint_count()[s] > 0 && slots.position()[s].w > 0)
            move(slots, s, model.relaxation_factor * xyz(slots.contact_push()[s]));
    }
    __syncthreads();
}

}  // namespace natator::cuda
