#pragma once

#include "cells.cuh"

namespace natator::cuda {

inline constexpr int search_threads = 128;
inline constexpr int staged_neighbours = 32;  ///< that a thread has room for on the chip while it searches

/// Lists the fluid neighbours of a fluid slot, without a branch on what is near: entries are written one behind the
/// other, and the next one over what was not near. What ends the last chunk is the far slot. Where lists have no room
/// for all, it notes how much they need.
template <class Real>
__device__ int list_fluid_neighbours(const ModelView<Real>& model, const Slots<Real>& slots, int s, const Vec3<Real>& x,
                                     int* staging) {
    uint4* const list = slots.arrays.neighbour + (static_cast<std::size_t>(s / 32) * slots.chunks * 32 + s % 32);
    const auto entry = [&](int k) -> unsigned& { return slots.neighbour_entry(s, k); };
    const int limit = model.max_neighbours, room = 4 * slots.chunks;
    int n = 0;
    const auto take = [&](int other, bool near) {
        near = near && n < limit;
        staging[min(n, staged_neighbours) * search_threads] = other;
        if (near && n >= staged_neighbours && n < room) entry(n) = static_cast<unsigned>(other);
        n += near;
    };
    if (model.plan.uniform_fluid) {
        for_each_candidate(model, slots, false, x, take);
    } else {
        const int i = slots.number()[s];
        for_each_candidate(model, slots, false, x, [&](int other, bool near) {
            take(other, near && collides(model, i, slots.number()[other]));
        });
    }
    if (n > room) {
        atomicMax(&slots.shared().needed.lists, n);
        n = room;
    }
    for (int k = n; k % 4 != 0; ++k) {
        if (k < staged_neighbours)
            staging[k * search_threads] = model.particles;
        else
            entry(k) = static_cast<unsigned>(model.particles);
    }
    const int in_staging = min((n + 3) / 4 * 4, staged_neighbours);
    for (int k = 0; k < in_staging; k += 4) {
        const auto staged = [&](int e) { return static_cast<unsigned>(staging[(k + e) * search_threads]); };
        list[k / 4 * 32] = {staged(0), staged(1), staged(2), staged(3)};
    }
    return n;
}

/// What lists the contacts of a solid as far as there is room.
template <class Real>
__device__ auto contact_lister(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    int* const list = slots.arrays.solid_contact + (s - model.fluid);
    return [list, room = slots.room.solid, stride = static_cast<std::size_t>(model.solids)](int k, int other) {
        if (k < room) list[k * stride] = other;
    };
}

/// Lists the contacts of a fluid slot as far as there is room, in the row of its place among the slots with contacts.
template <class Real>
__device__ void list_contacts_of_fluid(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    int row = 0;
    const int count = search_contacts(model, slots, s, [&](int k, int other) {
        if (k == 0) slots.arrays.contact_row[s] = row = add_contact_slot(slots, s);
        if (slots.room.holds(k + 1, row))
            slots.arrays.fluid_contact[static_cast<std::size_t>(k) * slots.room.fluid_rows + row] = other;
    });
    slots.contact_count()[s] = count;
}

/// Lists fluid neighbours, contacts and planes of a fluid slot. Walls of water are mirrors.
template <class Real>
__device__ void find_neighbours_of_fluid(const ModelView<Real>& model, const Slots<Real>& slots, int s, int* staging) {
    const Vec4<Real> here = slots.predicted_position()[s];
    const Vec3<Real> x = xyz(here);
    if (model.plan.fluid) slots.neighbour_count()[s] = list_fluid_neighbours(model, slots, s, x, staging);
    if (model.plan.contacts) {
        if (!model.plan.water && near_solids(slots, x))
            list_contacts_of_fluid(model, slots, s);
        else
            slots.contact_count()[s] = 0;
    }
    if (model.plan.water)
        slots.plane_contact()[s] = 0;
    else
        note_near_planes(model, slots, s, here);
}

/// Lists the neighbours of every slot at the predicted positions: first a warp for each solid, which takes longest,
/// then a thread for each fluid slot.
template <class Real>
__device__ void find_neighbours_on_grid(const ModelView<Real>& model, const Slots<Real>& slots) {
    __shared__ int staging[(staged_neighbours + 1) * search_threads];
    const int thread = own_index(), solid = thread / 32, for_solids = 32 * model.solids;
    if (thread < for_solids) return find_neighbours_of_solid(model, slots, model.fluid + solid);
    const int s = thread - for_solids;
    if (s < model.fluid) find_neighbours_of_fluid(model, slots, s, staging + threadIdx.x);
}

}  // namespace natator::cuda
