#pragma once

// Who is whose neighbour in scheme conserving, and the sums over neighbours that need nothing but where they are.
#include "physics/dfsph.h"
#include "water_neighbours.cuh"

namespace natator::cuda {

/// Calls keep(n, k) for neighbour n of a slot, which is candidate k of the water: what is within the kernel's support of it, solids and ghosts too, in the order of the
/// cells. Returns how many there are, 0 for no slot. Lanes of a warp stay together, those that have no candidate left as well.
template <class Real, class Keep>
__device__ int search_water(const ModelView<Real>& model, const Slots<Real>& slots, int slot, const Keep& keep) {
    const int lane = own_lane(), first_lane = static_cast<int>(threadIdx.x) % 32 - lane;
    const int s = min(slot, model.particles - 1);
    const WaterArrays<Real>& water = slots.water;
    const GridView<Real>& grid = model.water.grid;
    const Vec3<Real> x = xyz(water.position[s]);
    const Real distance_squared = model.water.radius * model.water.radius;
    const unsigned lanes_before = (1u << lane) - 1;
    const int cx = grid.coordinate(x.x, 0), cy = grid.coordinate(x.y, 1), cz = grid.coordinate(x.z, 2);
    const int low = max(cx - grid.reach_x, 0), high = min(cx + grid.reach_x, grid.count[0] - 1);
    int n = 0;
    for (int around = 0; around < 9; ++around) {
        const int iy = cy + around % 3 - 1, iz = cz + around / 3 - 1;
        int from = 0, to = 0;
        if (slot == s && iy >= 0 && iy < grid.count[1] && iz >= 0 && iz < grid.count[2]) {
            const int row = (iz * grid.count[1] + iy) * grid.count[0];
            from = row + low > 0 ? water.table[row + low - 1] : 0;
            to = min(water.table[row + high], slots.water_room.copies);
        }
        int most = to - from;
        for (int step = pair_lanes; step < 32; step *= 2) most = max(most, __shfl_xor_sync(0xffffffff, most, step));
        for (int k = from + lane; most > 0; most -= pair_lanes, k += pair_lanes) {
            Quad<Real> other{};
            bool near = k < to;
            if (near) {
                other = water.candidate[k];
                const Real r2 = physics::squared_length(x - xyz(other));
                near = r2 < distance_squared && r2 > 0;
            }
            const unsigned found = __ballot_sync(0xffffffff, near) >> first_lane & ((1u << pair_lanes) - 1);
            if (near) keep(n + __popc(found & lanes_before), k);
            n += __popc(found);
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
    constexpr int stride = staged + water_lists;  // lists of a warp begin in banks of their own
    __shared__ unsigned staging[slots_of_row * stride];
    __shared__ int longest, first_row;
    const WaterArrays<Real>& water = slots.water;
    const int row = static_cast<int>(blockIdx.x), lane = own_lane(), own = static_cast<int>(threadIdx.x) / water_lists;
    const int slot = row * slots_of_row + own;
    unsigned* const list = staging + own * stride;
    if (threadIdx.x == 0) longest = 0;
    const int n = search_water(model, slots, slot, [&](int k, int candidate) {
        if (k < staged) list[k] = candidate;
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
        search_water(model, slots, slot, [&](int k, int candidate) { place[place_of(k)] = candidate; });
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
