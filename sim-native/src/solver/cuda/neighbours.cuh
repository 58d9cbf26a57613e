#pragma once

#include "contacts.cuh"

namespace natator::cuda {

/// Without pairs to search slots keep their numbers.
template <class Real>
__device__ bool needs_cells(const ModelView<Real>& model) {
    return model.plan.fluid || model.plan.contacts;
}

template <class Real>
__device__ Vec3<Real> predicted_velocity(const ModelView<Real>& model, const Vec3<Real>& v, Real inverse_mass, bool fluid,
                                     Real h) {
    return physics::predicted_velocity(v, inverse_mass, fluid ? model.fluid_gravity : model.gravity, h,
                                   model.plan.clamp_speed, model.max_speed);
}

/// v*, x* = x + h v*; counts the particles of each cell, the fluid's first. Ends with a barrier.
template <class Real, class Block>
__device__ void predict(const ModelView<Real>& model, Block& block) {
    std::uint32_t* const table = block.table();
    for (int c = threadIdx.x; c < model.grid.cells; c += threads) table[c] = 0;
    __syncthreads();
    for (int k = threadIdx.x; k < model.clusters; k += threads) block.fit_before()[k] = block.fit()[k];
    for (int s = threadIdx.x; s < model.particles; s += threads) {
        const Quad<Real> x = block.position()[s];
        const Real inverse_mass = x.w;
        const Vec3<Real> v = predicted_velocity(model, xyz(block.velocity[s]), inverse_mass, s < model.fluid, block.h);
        const Vec3<Real> there = xyz(x) + block.h * v;
        block.unsorted_position()[s] = quad(there, as_number<Real>(block.number()[s]));
        block.unsorted_velocity()[s] = quad(v, inverse_mass);
        if (needs_cells(model)) count_up(table, model.grid.cell(there) + (s < model.fluid ? 0 : model.grid.cells));
    }
    __syncthreads();
}

/// Box around the solids at their predicted positions, by the first warp.
template <class Real, class Block>
__device__ void bound_solids(const ModelView<Real>& model, Block& block) {
    if (threadIdx.x >= 32) return;
    Real low[3] = {Real(1e30), Real(1e30), Real(1e30)}, high[3] = {Real(-1e30), Real(-1e30), Real(-1e30)};
    for (int s = model.fluid + threadIdx.x; s < model.particles; s += 32) {
        const Quad<Real> x = block.position()[s];
        const Real at[3] = {x.x, x.y, x.z};
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = min(low[axis], at[axis]);
            high[axis] = max(high[axis], at[axis]);
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        for (int step = 16; step > 0; step /= 2) {
            low[axis] = min(low[axis], __shfl_xor_sync(0xffffffff, low[axis], step));
            high[axis] = max(high[axis], __shfl_xor_sync(0xffffffff, high[axis], step));
        }
        if (threadIdx.x == 0) {
            block.shared().solids_low[axis] = low[axis] - model.search_distance;
            block.shared().solids_high[axis] = high[axis] + model.search_distance;
        }
    }
}

/// Keys of the slots, number and slot before, in the order that slots will have: counting sort by cell, then by
/// particle within each cell, which makes the order the same whatever order the atomics came in. Leaves the cells' ends
/// in the table. Ends with a barrier.
template <class Real, class Block>
__device__ void sort_keys(const ModelView<Real>& model, Block& block) {
    std::uint32_t* const table = block.table();
    std::uint32_t* const keys = block.keys();
    const auto key_of = [](int number, int s) { return static_cast<std::uint32_t>(number) << 16 | s; };
    if (!needs_cells(model)) {
        for (int s = threadIdx.x; s < model.particles; s += threads) keys[s] = key_of(block.number()[s], s);
        __syncthreads();
        return;
    }
    exclusive_scan(table, 2 * model.grid.cells, block.scan());
    for (int s = threadIdx.x; s < model.particles; s += threads) {
        const Quad<Real> there = block.unsorted_position()[s];
        const int cell = model.grid.cell(xyz(there)) + (s < model.fluid ? 0 : model.grid.cells);
        keys[count_up(table, cell)] = key_of(number_in(there.w), s);
    }
    __syncthreads();
    for (int c = threadIdx.x; c < 2 * model.grid.cells; c += threads) {
        const int begin = c > 0 ? half_of(table, c - 1) : 0, end = half_of(table, c);
        for (int k = begin + 1; k < end; ++k) {
            const std::uint32_t key = keys[k];
            int place = k;
            for (; place > begin && keys[place - 1] > key; --place) keys[place] = keys[place - 1];
            keys[place] = key;
        }
    }
    __syncthreads();
}

/// Numbers the slots anew and puts everything in its new place. Ends with a barrier.
template <class Real, class Block>
__device__ void sort_into_cells(const ModelView<Real>& model, Block& block) {
    sort_keys(model, block);
    const std::uint32_t* const keys = block.keys();
    for (int s = threadIdx.x; s < model.particles; s += threads) {
        const int before = keys[s] & 0xffff;
        block.start()[s] = block.position()[before];
        block.predicted_velocity()[s] = block.unsorted_velocity()[before];
    }
    __syncthreads();
    for (int s = threadIdx.x; s < model.particles; s += threads) {
        const std::uint32_t key = keys[s];
        const int number = static_cast<int>(key >> 16);
        const Quad<Real> there = quad(xyz(block.unsorted_position()[key & 0xffff]), block.predicted_velocity()[s].w);
        block.position()[s] = there;
        block.number()[s] = static_cast<std::uint16_t>(number);
        if (s >= model.fluid) block.slot_of_solid()[number - model.fluid] = static_cast<std::uint16_t>(s);
    }
    __syncthreads();
    if (model.plan.contacts) bound_solids(model, block);
    if (threadIdx.x == 0) block.shared().touched = 0;
    __syncthreads();
}

/// Does particle i feel particle j? The same as Substep::collides.
template <class Real>
__device__ bool collides(const ModelView<Real>& model, int i, int j) {
    if ((model.phase[i] & phase::group_mask) != (model.phase[j] & phase::group_mask)) return true;
    if (!(model.phase[i] & phase::self_collide)) return false;
    if (!(model.phase[i] & phase::self_collide_filter) || !model.rest_position) return true;
    return norm(model.rest_position[i] - model.rest_position[j]) >= model.radius;
}

/// Calls visit(slot, nearer than the search distance) for the slots in the cells around x, of the fluid or the solids.
template <class Real, class Block, class Visit>
__device__ void for_each_candidate(const ModelView<Real>& model, const Block& block, bool solids, const Vec3<Real>& x,
                                   const Visit& visit) {
    const std::uint32_t* const table = block.table();
    const int offset = solids ? model.grid.cells : 0;
    const Real distance_squared = model.search_distance * model.search_distance;
    model.grid.for_each_run(x, [&](int first, int last) {
        const int begin = first + offset > 0 ? half_of(table, first + offset - 1) : 0;
        const int end = half_of(table, last + offset);
        for (int other = begin; other < end; ++other) {
            const Vec3<Real> difference = x - xyz(block.position()[other]);
            const Real r2 = dot(difference, difference);
            visit(other, r2 < distance_squared && r2 > 0);
        }
    });
}

/// Entry k of the list of fluid neighbours of slot s.
template <class Real, class Block>
__device__ std::uint16_t& list_entry(const ModelView<Real>& model, const Block& block, int s, int k) {
    uint4* const chunk = block.neighbour() + static_cast<std::size_t>(k / 8) * model.fluid + s;
    return reinterpret_cast<std::uint16_t*>(chunk)[k % 8];
}

/// Lists the fluid neighbours of a fluid slot. Entries are written on the chip first, one behind the other, without a
/// branch on what is near: what is not is written over by the next. A list that is too long for that is made anew in
/// its place. What ends the last chunk is the far slot.
template <class Real, class Block>
__device__ void list_fluid_neighbours(const ModelView<Real>& model, Block& block, int s, const Vec3<Real>& x) {
    std::uint16_t* const staging = block.staging() + threadIdx.x;
    const int staged = min(block.staged(), model.most_neighbours / 8 * 8);
    const int i = model.plan.uniform_fluid ? 0 : block.number()[s];
    const auto felt = [&](int other) {
        return model.plan.uniform_fluid || collides(model, i, static_cast<int>(block.number()[other]));
    };
    int n = 0;
    if (model.plan.uniform_fluid)
        for_each_candidate(model, block, false, x, [&](int other, bool near) {
            staging[min(n, staged) * threads] = static_cast<std::uint16_t>(other);
            n += near;
        });
    else
        for_each_candidate(model, block, false, x, [&](int other, bool near) {
            staging[min(n, staged) * threads] = static_cast<std::uint16_t>(other);
            n += near && felt(other);
        });
    const std::uint16_t beyond = static_cast<std::uint16_t>(model.particles);
    if (n > staged) {
        n = 0;
        for_each_candidate(model, block, false, x, [&](int other, bool near) {
            if (!near || n >= model.most_neighbours || !felt(other)) return;
            list_entry(model, block, s, n) = static_cast<std::uint16_t>(other);
            ++n;
        });
        for (int k = n; k % 8 != 0; ++k) list_entry(model, block, s, k) = beyond;
    } else {
        for (int k = n; k % 8 != 0; ++k) staging[k * threads] = beyond;
        for (int k = 0; k < n; k += 8) {
            const auto two = [&](int e) {
                return staging[(k + e) * threads] | static_cast<unsigned>(staging[(k + e + 1) * threads]) << 16;
            };
            block.neighbour()[static_cast<std::size_t>(k / 8) * model.fluid + s] = {two(0), two(2), two(4), two(6)};
        }
    }
    block.neighbour_count()[s] = static_cast<std::uint16_t>(n);
}

/// Appends the slots near x that slot s is in contact with to a list; returns how many it has then.
template <class Real, class Block>
__device__ int append_contacts(const ModelView<Real>& model, const Block& block, bool solids, int s,
                               const Vec3<Real>& x, std::uint16_t* list, int stride, int n) {
    const int i = block.number()[s];
    for_each_candidate(model, block, solids, x, [&](int other, bool near) {
        if (!near) return;
        const int j = block.number()[other];
        if (!collides(model, i, j) && !(model.plan.mutual_contacts && collides(model, j, i))) return;
        list[static_cast<std::size_t>(n) * stride] = static_cast<std::uint16_t>(other);
        ++n;
    });
    return n;
}

template <class Real, class Block>
__device__ int list_contacts(const ModelView<Real>& model, const Block& block, int s, const Vec3<Real>& x) {
    if (s >= model.fluid) {
        std::uint16_t* const list = block.solid_contact() + (s - model.fluid);
        const int n = append_contacts(model, block, false, s, x, list, model.solids, 0);
        return append_contacts(model, block, true, s, x, list, model.solids, n);
    }
    const auto& shared = block.shared();
    const Real at[3] = {x.x, x.y, x.z};
    for (int axis = 0; axis < 3; ++axis)
        if (at[axis] < shared.solids_low[axis] || at[axis] > shared.solids_high[axis]) return 0;
    return append_contacts(model, block, true, s, x, block.fluid_contact() + s, model.fluid, 0);
}

/// Lists fluid neighbours, contacts and planes of every slot at the predicted positions. Ends with a barrier.
template <class Real, class Block>
__device__ void find_neighbours(const ModelView<Real>& model, Block& block) {
    // The last slots first: solids take longest.
    const int units = (model.particles + 31) / 32;
    for_each_unit(block, units, [&](int unit) {
        const int s = (units - 1 - unit) * 32 + threadIdx.x % 32;
        if (s >= model.particles) return;
        const Quad<Real> here = block.position()[s];
        const Vec3<Real> x = xyz(here);
        if (s < model.fluid) list_fluid_neighbours(model, block, s, x);
        if (model.plan.contacts) {
            const int contacts = list_contacts(model, block, s, x);
            block.contact_count()[s] = static_cast<std::uint16_t>(contacts);
            if (contacts > 0) block.touched()[atomicAdd(&block.shared().touched, 1)] = static_cast<std::uint16_t>(s);
        }
        unsigned planes = 0;
        for (int k = 0; k < model.planes; ++k)
            if (distance_to(model.plane[k].surface, x) <= model.plane_search_distance) planes |= 1u << k;
        block.plane_contact()[s] = static_cast<std::uint16_t>(here.w > 0 ? planes : 0);
    });
    __syncthreads();
    // `next` was room for the search; its far slot is what lists end with.
    if (threadIdx.x == 0) block.next()[model.particles] = far_away<Real>();
    __syncthreads();
}

}  // namespace natator::cuda
