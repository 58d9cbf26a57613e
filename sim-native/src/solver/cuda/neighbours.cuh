#pragma once

#include "conserving_overlap.cuh"

namespace natator::cuda {

/// v* = v + h g, |v*| <= maxSpeed, x* = x + h v*; counts the particles of each cell. As cpu/predict.cpp.
template <Scheme scheme, class Real>
__device__ void predict(const ModelView<Real>& model, Block<Real>& block) {
    int* const table = block.cell_table();
    for (int c = threadIdx.x; c < 2 * model.grid.cells; c += threads) table[c] = 0;
    __syncthreads();
    for (int k = threadIdx.x; k < model.clusters; k += threads) block.fit_before[k] = block.fit[k];
    for (int s = threadIdx.x; s < model.particles; s += threads) {
        Quad<Real> x = block.position[s];
        Vec3<Real> v = xyz(block.velocity[s]);
        const int i = number_in(x.w);
        const Real inverse_mass = model.inverse_mass[i];
        if (scheme == Scheme::conserving && inverse_mass > 0) {
            x = quad(put_before_planes(model, xyz(x)), x.w);
            block.position[s] = x;
        }
        if (inverse_mass > 0) v = v + block.h * (s < model.fluid ? model.fluid_gravity : model.gravity);
        if (model.plan.clamp_speed) v = clamped(v, model.max_speed);
        const Vec3<Real> there = xyz(x) + block.h * v;
        block.predicted[s] = quad(there, x.w);
        block.drift_before[s] = quad(v, inverse_mass);
        atomicAdd(&table[model.grid.cell(there) + (s < model.fluid ? 0 : model.grid.cells)], 1);
    }
    __syncthreads();
}

/// Numbers the slots anew: counting sort by cell, then by particle within each cell, which makes the order the same
/// whatever order the atomics came in. Leaves the cells' ends in the table.
template <Scheme scheme, class Real>
__device__ void sort_into_cells(const ModelView<Real>& model, Block<Real>& block) {
    int* const table = block.cell_table();
    std::uint32_t* const keys = block.keys(model.grid.cells);
    exclusive_scan(table, 2 * model.grid.cells, block.scan);
    for (int s = threadIdx.x; s < model.particles; s += threads) {
        const Quad<Real> there = block.predicted[s];
        const int cell = model.grid.cell(xyz(there)) + (s < model.fluid ? 0 : model.grid.cells);
        keys[atomicAdd(&table[cell], 1)] = static_cast<std::uint32_t>(number_in(there.w)) << 16 | s;
    }
    __syncthreads();
    for (int c = threadIdx.x; c < 2 * model.grid.cells; c += threads) {
        const int begin = c > 0 ? table[c - 1] : 0, end = table[c];
        for (int k = begin + 1; k < end; ++k) {
            const std::uint32_t key = keys[k];
            int place = k;
            for (; place > begin && keys[place - 1] > key; --place) keys[place] = keys[place - 1];
            keys[place] = key;
        }
    }
    __syncthreads();
    for (int s = threadIdx.x; s < model.particles; s += threads) {
        const int before = keys[s] & 0xffff;
        block.start[s] = block.position[before];
        block.drift[s] = block.drift_before[before];
    }
    __syncthreads();
    for (int s = threadIdx.x; s < model.particles; s += threads) {
        const Quad<Real> there = block.predicted[keys[s] & 0xffff];
        block.position[s] = there;
        if (scheme == Scheme::conserving) block.base[s] = there;
        if (s >= model.fluid) block.slot_of_solid[number_in(there.w) - model.fluid] = static_cast<std::uint16_t>(s);
    }
    __syncthreads();
}

/// Does particle i feel particle j? As Substep::collides.
template <class Real>
__device__ bool collides(const ModelView<Real>& model, int i, int j) {
    if ((model.phase[i] & phase::group_mask) != (model.phase[j] & phase::group_mask)) return true;
    if (!(model.phase[i] & phase::self_collide)) return false;
    if (!(model.phase[i] & phase::self_collide_filter) || !model.rest_position) return true;
    return norm(model.rest_position[i] - model.rest_position[j]) >= model.radius;
}

/// Appends the slots of the runs that are nearer than the search distance to a list of stride `stride`, at most `most`.
/// `accept(other slot)` decides beyond the distance. Returns the number.
template <class Real, class Accept>
__device__ int append_neighbours(const ModelView<Real>& model, const Block<Real>& block, int table_offset,
                                 const Vec3<Real>& x, std::uint16_t* list, int stride, int most, int n,
                                 const Accept& accept) {
    const int* const ends = block.cell_table() + table_offset;
    const Real distance_squared = model.search_distance * model.search_distance;
    model.grid.for_each_run(x, [&](int first, int last) {
        const int begin = first + table_offset > 0 ? ends[first - 1] : 0, end = ends[last];
        for (int other = begin; other < end; ++other) {
            const Vec3<Real> difference = x - xyz(block.position[other]);
            const Real r2 = dot(difference, difference);
            if (r2 < distance_squared && r2 > 0 && n < most && accept(other)) {
                list[static_cast<std::size_t>(n) * stride] = static_cast<std::uint16_t>(other);
                ++n;
            }
        }
    });
    return n;
}

/// Lists fluid neighbours, contacts and planes of every slot at the predicted positions. As
/// cpu/find_fluid_neighbours.cpp and cpu/find_contacts.cpp.
template <class Real>
__device__ void find_neighbours(const ModelView<Real>& model, Block<Real>& block) {
    const int cells = model.grid.cells;
    if (threadIdx.x == 0) *block.touched_count = 0;
    __syncthreads();
    for (int s = threadIdx.x; s < model.particles; s += threads) {
        const Quad<Real> here = block.position[s];
        const Vec3<Real> x = xyz(here);
        const int i = number_in(here.w);
        const auto felt = [&](int other) { return collides(model, i, number_in(block.position[other].w)); };
        const auto in_contact = [&](int other) {
            const int j = number_in(block.position[other].w);
            return collides(model, i, j) || (model.plan.mutual_contacts && collides(model, j, i));
        };
        const auto any = [](int) { return true; };
        int contacts = 0;
        if (s < model.fluid) {
            std::uint16_t* const list = block.neighbour + s;
            const int n =
                model.plan.uniform_fluid
                    ? append_neighbours(model, block, 0, x, list, model.fluid, model.most_neighbours, 0, any)
                    : append_neighbours(model, block, 0, x, list, model.fluid, model.most_neighbours, 0, felt);
            block.neighbour_count[s] = static_cast<std::uint16_t>(n);
            if (model.plan.contacts)
                contacts = append_neighbours(model, block, cells, x, block.fluid_contact + s, model.fluid, model.solids,
                                             0, in_contact);
        } else if (model.plan.contacts) {
            std::uint16_t* const list = block.solid_contact + (s - model.fluid);
            contacts = append_neighbours(model, block, 0, x, list, model.solids, model.particles, 0, in_contact);
            contacts =
                append_neighbours(model, block, cells, x, list, model.solids, model.particles, contacts, in_contact);
        }
        if (model.plan.contacts) block.contact_count[s] = static_cast<std::uint16_t>(contacts);
        if (contacts > 0) block.touched[atomicAdd(block.touched_count, 1)] = static_cast<std::uint16_t>(s);
        unsigned planes = 0;
        for (int k = 0; k < model.planes; ++k)
            if (dot(model.plane[k].normal, x) + model.plane[k].offset <= model.plane_search_distance) planes |= 1u << k;
        block.plane_contact[s] = static_cast<std::uint16_t>(model.inverse_mass[i] > 0 ? planes : 0);
    }
    __syncthreads();
}

}  // namespace natator::cuda
