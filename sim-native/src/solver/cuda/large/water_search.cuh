#pragma once

// Who is whose neighbour in scheme conserving, and the sums over neighbours that need nothing but where they are.
#include "physics/dfsph.h"
#include "water_neighbours.cuh"

namespace natator::cuda {

/// Candidates [begin, end) of a search.
struct Candidates {
    int begin, end;
};

/// Those of row `around` of the nine rows of cells around x, but for cells that are further away than the kernel's support.
template <class Real>
__device__ Candidates candidates_around(const ModelView<Real>& model, const Slots<Real>& slots, const Vec3<Real>& x,
                                        int around) {
    const GridView<Real>& grid = model.water.grid;
    const int step_y = around % 3 - 1, step_z = around / 3 - 1;
    const int iy = grid.coordinate(x.y, 1) + step_y, iz = grid.coordinate(x.z, 2) + step_z;
    if (iy < 0 || iy >= grid.count[1] || iz < 0 || iz >= grid.count[2]) return {0, 0};
    const Real reach = (1 + Real(1) / 64) * model.water.radius;  // where cells end is rounded
    const Real y = grid.distance_to_row(x.y, 1, step_y), z = grid.distance_to_row(x.z, 2, step_z);
    const Real square = reach * reach - y * y - z * z;
    if (!(square > 0)) return {0, 0};
    const Real half = physics::square_root(square);
    const int row = (iz * grid.count[1] + iy) * grid.count[0];
    const int low = row + grid.coordinate(x.x - half, 0), high = row + grid.coordinate(x.x + half, 0);
    const int* const table = slots.water.table;
    return {low > 0 ? table[low - 1] : 0, min(table[high], slots.water_room.copies)};
}

/// Calls keep(near, n, k) for candidates k of a slot, in the order of the cells. Those that are `near` are its neighbours n: what is
/// within the kernel's support of it, solids and ghosts too. Returns how many there are, 0 for no slot. A lane looks up a row of cells
/// for all that share the slot. Lanes of a warp stay together, those that have no candidate left as well.
template <class Real, class Keep>
__device__ int search_water(const ModelView<Real>& model, const Slots<Real>& slots, int slot, const Keep& keep) {
    constexpr int rows = 9;
    const int lane = own_lane(), first_lane = static_cast<int>(threadIdx.x) % 32 - lane;
    const WaterArrays<Real>& water = slots.water;
    const Vec3<Real> x = xyz(water.position[min(slot, model.particles - 1)]);
    const Real distance_squared = model.water.radius * model.water.radius;
    const unsigned own_lanes = ((1u << pair_lanes) - 1) << first_lane, lanes_before = ((1u << lane) - 1) << first_lane;
    const unsigned last_copy = slots.water_room.copies - 1;
    const Quad<Real>* const candidate = water.candidate;
    Candidates own{0, 0};
    int n = 0;
#pragma unroll 1
    for (int around = 0; around < rows; ++around) {
        if (around % pair_lanes == 0 && slot < model.particles)
            own = candidates_around(model, slots, x, min(around + lane, rows - 1));
        const int begin = __shfl_sync(0xffffffff, own.begin, around % pair_lanes, pair_lanes);
        const int end = __shfl_sync(0xffffffff, own.end, around % pair_lanes, pair_lanes);
        int most = end - begin;
        for (int step = pair_lanes; step < 32; step *= 2) most = max(most, __shfl_xor_sync(0xffffffff, most, step));
#pragma unroll 2
        for (int k = begin + lane; most > 0; most -= pair_lanes, k += pair_lanes) {
            const Real r2 = physics::squared_length(x - xyz(candidate[min(static_cast<unsigned>(k), last_copy)]));
            const bool near = k < end && r2 < distance_squared && r2 > 0;
            const unsigned found = __ballot_sync(0xffffffff, near);
            keep(near, n + __popc(found & lanes_before), k);
            n += __popc(found & own_lanes);
        }
    }
    return n;
}

/// Gives the slots of a row so many rows. Returns the first, -1 where there is no room for all, and notes what they need. One thread.
template <class Real>
__device__ int take_rows(const Slots<Real>& slots, int rows) {
    const int first = atomicAdd(&slots.shared().rows, rows), end = first + rows;
    if (end <= slots.water_room.lists) return first;
    atomicMax(&slots.shared().needed.lists, end);
    return -1;
}

/// Of the particle in slot s; the fluid's is known without a look.
template <class Real>
__device__ Real volume_at(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    return s < model.fluid ? model.water.fluid_volume : slots.water.position[s].w;
}

/// Density, correction and crowding of a slot, by its threads' sums.
template <class Real>
__device__ void keep_moments(const ModelView<Real>& model, const Slots<Real>& slots, int s, physics::MomentSums<Real> sums) {
    sums.density = sum_of_lanes(sums.density);
    sums.moments = sum_of_lanes(sums.moments);
    sums.crowding = sum_of_lanes(sums.crowding);
    if (own_lane() != 0 || s >= model.particles) return;
    const WaterArrays<Real>& water = slots.water;
    const int number = number_in(slots.at.state_velocity[s].w);
    const Real volume = water.position[s].w, density = sums.density + volume * model.water.kernel.scale;
    const physics::Symmetric3<Real> l = sums.correction(density);
    water.density[s] = density;
    water.density_of[number] = density;
    water.correction[s] = {l.xx, l.yy, l.zz, l.xy};
    const Real solid = number < model.fluid ? Real(0) : Real(1);
    water.shear[s] = {l.xz, l.yz, physics::mobility(water.velocity[s].w, volume, model.water.density), solid};
    water.crowding[s] = quad(sums.crowding, Real(0));
    water.volume[s] = volume;
    if (density - 1 > Real(physics::overlap_tolerance)) slots.shared().high = 1;
}

/// Lists the neighbours of every slot, and computes its density. A block has the slots of a row: it searches for their neighbours
/// into lists on the chip, which have room for `staged` candidates each, and then knows how many rows they need. Where some are
/// longer, it searches once more. Each thread goes through its share of a list, as in for_each_water_neighbour, while the candidates
/// are still in the cache.
template <int staged, class Real>
__device__ void find_water_neighbours_large(const ModelView<Real>& model, const Slots<Real>& slots) {
    // What does not belong into a list goes behind it, by lane; so lists of a warp begin in banks of their own.
    constexpr int stride = staged + water_lists;
    __shared__ unsigned staging[slots_of_row * stride];
    __shared__ int longest, first_row;
    const WaterArrays<Real>& water = slots.water;
    const int row = static_cast<int>(blockIdx.x), lane = own_lane(), own = static_cast<int>(threadIdx.x) / water_lists;
    const int slot = row * slots_of_row + own;
    unsigned* const list = staging + own * stride;
    if (threadIdx.x == 0) longest = 0;
    const int n = search_water(model, slots, slot, [&](bool near, int k, int candidate) {
        list[near && k < staged ? k : staged + lane] = candidate;
    });
    __syncthreads();
    if (lane == 0) atomicMax(&longest, n);
    __syncthreads();
    if (threadIdx.x == 0) {
        first_row = take_rows(slots, (longest + water_lists - 1) / water_lists);
        water.first_row[row] = max(first_row, 0);
    }
    __syncthreads();
    const int kept = first_row < 0 ? 0 : n;
    if (lane == 0 && slot < model.particles) {
        water.count[slot] = kept;
        water.count_of[number_in(slots.at.state_velocity[slot].w)] = n;
    }
    unsigned* const place = water.neighbour + static_cast<std::size_t>(max(first_row, 0)) * water_row + own * water_lists;
    const bool on_chip = longest <= staged;
    if (!on_chip && first_row >= 0) {
        search_water(model, slots, slot, [&](bool near, int k, int candidate) {
            if (near) place[place_of(k)] = candidate;
        });
        __syncthreads();
    }
    const Vec3<Real> x = xyz(water.position[min(slot, model.particles - 1)]);
    physics::MomentSums<Real> sums;
    for (int k = lane, at = reversed_list(lane); k < kept; k += water_lists, at += water_row) {
        const Quad<Real> other = water.candidate[on_chip ? list[k] : place[at]];
        const auto entry = static_cast<unsigned>(number_in(other.w));
        place[at] = entry;
        sums.add(x - xyz(other), model.water.kernel, model.water.at_spacing, volume_at(model, slots, entry & slot_mask));
    }
    keep_moments(model, slots, slot, sums);
}

}  // namespace natator::cuda
