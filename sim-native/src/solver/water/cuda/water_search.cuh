#pragma once

// Who is whose neighbour in scheme conserving, and the sums over neighbours that need nothing but where they are.
#include "physics/dfsph.h"
#include "water_candidates.cuh"
#include "water_neighbours.cuh"

namespace natator::cuda {

/// Gives the slots of a row so many rows. Returns the first, -1 where there is no room for all, and notes what they
/// need. One thread.
template <class Real>
__device__ int take_rows(const Slots<Real>& slots, int rows) {
    const int first = atomicAdd(&slots.shared().rows, rows), end = first + rows;
    if (end <= slots.water_room.lists) return first;
    atomicMax(&slots.shared().needed.lists, end);
    return -1;
}

/// Volume of the particle in slot s; that of the fluid is not read from memory.
template <class Real>
__device__ Real volume_at(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    return s < model.fluid ? model.water.fluid_volume : slots.water.position[s].w;
}

/// Density, correction and crowding of a slot, by its threads' sums.
template <class Real>
__device__ void keep_moments(const ModelView<Real>& model, const Slots<Real>& slots, int s,
                             physics::MomentSums<Real> sums) {
    sums.density = sum_of_lanes(sums.density);
    sums.moments = sum_of_lanes(sums.moments);
    sums.crowding = sum_of_lanes(sums.crowding);
    if (own_lane() != 0 || s >= model.particles) return;
    const WaterArrays<Real>& water = slots.water;
    const int number = number_in(slots.arrays.state_velocity[s].w);
    const Real volume = water.position[s].w, density = sums.density + volume * model.water.kernel.scale;
    const physics::Symmetric3<Real> l = sums.correction(density);
    water.density[s] = density;
    water.correction[s] = {l.xx, l.yy, l.zz, l.xy};
    const Real solid = number < model.fluid ? Real(0) : Real(1);
    water.shear[s] = {l.xz, l.yz, physics::mobility(water.velocity[s].w, volume, model.water.density), solid};
    water.crowding[s] = quad(sums.crowding, Real(0));
    water.volume[s] = volume;
    if (density - 1 > Real(physics::overlap_tolerance)) slots.shared().high = 1;
}

/// Lists the neighbours of every slot, and computes its density. A block has the slots of a row: it searches for their
/// neighbours into lists on the chip, which have room for `staged` candidates each, and then knows how many rows they
/// need. Where some are longer, it searches once more. Each thread goes through its share of a list, as in
/// for_each_water_neighbour, while the candidates are still in the cache.
template <int staged, class Real>
__device__ void find_water_neighbours_on_grid(const ModelView<Real>& model, const Slots<Real>& slots) {
    // What does not belong into a list goes behind it, by lane; so lists of a warp begin in banks of their own.
    constexpr int stride = staged + water_lists;
    __shared__ unsigned staging[slots_of_row * stride];
    __shared__ int max_count, first_row;
    const WaterArrays<Real>& water = slots.water;
    const int row = static_cast<int>(blockIdx.x), lane = own_lane(), own = static_cast<int>(threadIdx.x) / water_lists;
    const int slot = row * slots_of_row + own;
    unsigned* const list = staging + own * stride;
    if (threadIdx.x == 0) max_count = 0;
    constexpr int unrolled = 2;
    const bool wanted = slot < model.particles;
    const auto stage = [&](int, bool near, int k, int candidate, const Vec4<Real>&) {
        list[near && k < staged ? k : staged + lane] = candidate;
    };
    const int n = search_water<unrolled>(model, slots, slot, wanted, AllLanes(), stage);
    __syncthreads();
    if (lane == 0) atomicMax(&max_count, n);
    __syncthreads();
    if (threadIdx.x == 0) {
        first_row = take_rows(slots, (max_count + water_lists - 1) / water_lists);
        water.first_row[row] = max(first_row, 0);
    }
    __syncthreads();
    const int kept = first_row < 0 ? 0 : n;
    if (lane == 0 && slot < model.particles) water.count[slot] = kept;
    unsigned* const place =
        water.neighbour + static_cast<std::size_t>(max(first_row, 0)) * water_row + own * water_lists;
    const bool on_chip = max_count <= staged;
    if (!on_chip && first_row >= 0) {
        const auto keep = [&](int, bool near, int k, int candidate, const Vec4<Real>&) {
            if (near) place[place_of(k)] = candidate;
        };
        search_water<unrolled>(model, slots, slot, wanted, AllLanes(), keep);
        __syncthreads();
    }
    const Vec3<Real> x = xyz(water.position[min(slot, model.particles - 1)]);
    physics::MomentSums<Real> sums;
    for (int k = lane, at = reversed_list(lane); k < kept; k += water_lists, at += water_row) {
        const Vec4<Real> other = water.candidate[on_chip ? list[k] : place[at]];
        const unsigned entry = entry_of(other);
        place[at] = entry;
        sums.add(x - xyz(other), model.water.kernel, model.water.at_spacing,
                 volume_at(model, slots, entry & slot_mask));
    }
    keep_moments(model, slots, slot, sums);
}

/// Computes the density of slot s, and its gradients' moments, without lists.
template <class Real>
__device__ void measure_moments(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const Vec3<Real> x = xyz(water.position[s]);
    physics::MomentSums<Real> sums;
    const int n = for_each_found(
        model, slots, s, model.particles, true, own_lane(), [](int k, const Vec4<Real>&) { return k; },
        [&](int k) {
            const Vec4<Real> other = water.candidate[k];
            sums.add(x - xyz(other), model.water.kernel, model.water.at_spacing,
                     volume_at(model, slots, entry_of(other) & slot_mask));
        });
    if (own_lane() == 0) water.count[s] = n;
    keep_moments(model, slots, s, sums);
}

}  // namespace natator::cuda
