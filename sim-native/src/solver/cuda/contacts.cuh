#pragma once

#include "physics/pair.h"
#include "physics/plane.h"
#include "state_team.cuh"

namespace natator::cuda {

/// Calls visit(slot) for every `step`th contact of slot s, from `first` on.
template <class Real, class Team, class Visit>
__device__ void for_each_contact_of(const ModelView<Real>& model, const Team& team, int s, int first, int step,
                                    const Visit& visit) {
    const bool fluid = s < model.fluid;
    const std::uint16_t* const list = fluid ? team.fluid_contact() + s : team.solid_contact() + (s - model.fluid);
    const std::size_t stride = fluid ? model.fluid : model.solids;
    const int count = team.contact_count()[s];
    for (int k = first; k < count; k += step) visit(static_cast<int>(list[k * stride]));
}

/// Calls visit(slot) for the contacts of slot s.
template <class Real, class Team, class Visit>
__device__ void for_each_contact(const ModelView<Real>& model, const Team& team, int s, const Visit& visit) {
    if (model.plan.contacts) for_each_contact_of(model, team, s, 0, 1, visit);
}

/// Calls visit(slot) for the fluid neighbours of fluid slot s, and for the far slot until a chunk is full.
template <class Real, class Team, class Visit>
__device__ void for_each_neighbour(const ModelView<Real>& model, const Team& team, int s, const Visit& visit) {
    const int chunks = (team.neighbour_count()[s] + 7) / 8;
    const uint4* chunk = team.neighbour() + s;
    if (chunks == 0) return;
    uint4 next = *chunk;
    for (int c = 1; c <= chunks; ++c) {
        const uint4 now = next;
        chunk += model.fluid;
        if (c < chunks) next = *chunk;
        const unsigned words[4] = {now.x, now.y, now.z, now.w};
#pragma unroll
        for (const unsigned word : words) {
            visit(static_cast<int>(word & 0xffff));
            visit(static_cast<int>(word >> 16));
        }
    }
}

/// Content of the far slot: a place beyond the reach of all others, without weight.
template <class Real>
__device__ Vec4<Real> far_away() {
    return {Real(physics::far_away), Real(physics::far_away), Real(physics::far_away), Real(0)};
}

/// The sum over the threads that share a slot, the same in all of them.
template <class Real>
__device__ Real sum_of_lanes(Real value) {
    for (int step = pair_lanes / 2; step > 0; step /= 2) value += __shfl_xor_sync(0xffffffff, value, step);
    return value;
}

/// Calls find(e), which gives a vector with a factor in w, for e = begin .. end - 1, each by one of the `lanes` threads
/// that share a slot; then, in all of these, add(what was found) in the order of e. Where threads share, all lanes of a
/// warp call it together.
template <int lanes, class Real, class Find, class Add>
__device__ void add_in_order(int begin, int end, const Find& find, const Add& add) {
    if constexpr (lanes == 1) {
        for (int e = begin; e < end; ++e) add(find(e));
    } else {
        constexpr unsigned all_lanes = 0xffffffff;
        const int lane = threadIdx.x % lanes;
        for (; __any_sync(all_lanes, begin < end); begin += lanes) {
            const Vec4<Real> own = begin + lane < end ? find(begin + lane) : Vec4<Real>{0, 0, 0, 0};
            for (int k = 0; k < lanes; ++k) {
                const auto of_lane = [&](Real value) { return __shfl_sync(all_lanes, value, k, lanes); };
                const Vec4<Real> found{of_lane(own.x), of_lane(own.y), of_lane(own.z), of_lane(own.w)};
                if (begin + k < end) add(found);
            }
        }
    }
}

/// Tasks of for_each_warp_task that the slots with contacts make.
template <class Real, class Team>
__device__ int contact_task_count(const ModelView<Real>& model, const Team& team) {
    return model.plan.contacts ? (team.shared().contact_slot_count * pair_lanes + 31) / 32 : 0;
}
/// Calls work(slot, lane) for the slots of such a task, `pair_lanes` threads each, all lanes of a warp together; slot
/// is -1 for those beyond the last.
template <class Team, class Work>
__device__ void for_each_contact_slot(const Team& team, int task, const Work& work) {
    const int lane = threadIdx.x % 32, k = task * (32 / pair_lanes) + lane / pair_lanes;
    work(k < team.shared().contact_slot_count ? static_cast<int>(team.contact_slots()[k]) : -1, lane % pair_lanes);
}

/// Friction in contacts of particles, and at planes.
template <class Real>
__device__ physics::Friction<Real> particle_friction(const ModelView<Real>& model) {
    return {model.plan.particle_friction, model.static_friction, model.particle_friction};
}
template <class Real>
__device__ physics::Friction<Real> plane_friction(const ModelView<Real>& model) {
    return {model.plan.plane_friction, model.static_friction, model.dynamic_friction};
}

/// Inverse mass of contact partner `other` as slot s feels it: shock propagation changes it.
template <class Real, class Team>
__device__ Real partner_weight(const ModelView<Real>& model, const Team& team, int s, int other) {
    const Real w = team.position()[other].w;
    if (!model.plan.shock_propagation) return w;
    return w *
           physics::shock_factor(model.up, model.shock_propagation, xyz(team.start()[s]) - xyz(team.start()[other]));
}

/// Displacement of slot s by a contact of this depth, before its share is taken.
template <class Real, class Team>
__device__ Vec3<Real> contact_push(const ModelView<Real>& model, const Team& team, int s, int other, Real depth) {
    const Vec3<Real> x = xyz(team.position()[s]), there = xyz(team.position()[other]);
    return physics::contact_push(x - there, norm(x - there), depth, particle_friction(model),
                                 [&] { return (x - xyz(team.start()[s])) - (there - xyz(team.start()[other])); });
}

/// Calls visit(plane, distance) for the planes of a set, the last plane first; x may change between two calls.
template <class Real, class Visit>
__device__ void for_each_near_plane(const ModelView<Real>& model, unsigned near, const Vec3<Real>& x,
                                    const Visit& visit) {
    if (near == 0) return;
    for (int k = model.planes - 1; k >= 0; --k)
        if (near >> k & 1) visit(model.plane[k].surface, distance_to(model.plane[k].surface, x));
}
/// The same for the planes near slot s.
template <class Real, class Team, class Visit>
__device__ void for_each_near_plane(const ModelView<Real>& model, const Team& team, int s, const Vec3<Real>& x,
                                    const Visit& visit) {
    for_each_near_plane(model, static_cast<unsigned>(team.plane_contact()[s]), x, visit);
}

}  // namespace natator::cuda
