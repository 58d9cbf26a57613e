#pragma once

// The search for the neighbours of the water, by the threads that share a slot.
#include <type_traits>

#include "water_ghosts.cuh"

namespace natator::cuda {

inline constexpr unsigned slot_mask = (1u << max_slot_bits) - 1;

/// Of the threads that share a slot.
__device__ inline int own_lane() {
    return static_cast<int>(threadIdx.x) % pair_lanes;
}

/// Entry of a candidate: its slot, with the boundaries that it is the ghost of.
template <class Real>
__device__ unsigned entry_of(const Vec4<Real>& candidate) {
    return static_cast<unsigned>(number_in(candidate.w));
}

/// Candidates [begin, end) of a search.
struct Candidates {
    int begin, end;
};

/// Those of row `around` of the nine rows of cells around x, but for cells that are further away than the kernel's
/// support.
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

/// All threads of a warp, for functions that take some of them: with a number that the compiler knows they take half of
/// the time.
using AllLanes = std::integral_constant<unsigned, 0xffffffff>;

/// A thread's value, from the thread itself: the compiler would compute it anew wherever it is used, if it knew how.
template <class Lanes>
__device__ unsigned kept_value(Lanes lanes, unsigned value) {
    return __shfl_sync(lanes, value, static_cast<int>(threadIdx.x) % 32);
}

/// The largest value of the slots that share a warp, whose threads are those of `lanes`.
template <class Lanes>
__device__ int max_of_slots(Lanes lanes, int value) {
    int largest = 0;
    for (int first = 0; first < 32; first += pair_lanes) {
        const int its = __shfl_sync(lanes, value, first);
        if (lanes >> first & 1) largest = max(largest, its);
    }
    return largest;
}

/// Calls keep(before, near, n, k, candidate) for candidates k of a slot, in the order of the cells. Those that are
/// `near` are its neighbours n: what is within the kernel's support of it, solids and ghosts too; `before` is how many
/// were found already, the same for all that share the slot. Returns how many there are, 0 if they are not `wanted`. A
/// lane looks up a row of cells for all that share the slot. The threads of a warp that are in `lanes` call it and stay
/// together, those that have no candidate left as well.
template <int unrolled, class Real, class Lanes, class Keep>
__device__ int search_water(const ModelView<Real>& model, const Slots<Real>& slots, int slot, bool wanted, Lanes lanes,
                            const Keep& keep) {
    constexpr int rows = 9;
    const int lane = own_lane(), first_lane = static_cast<int>(threadIdx.x) % 32 - lane;
    const WaterArrays<Real>& water = slots.water;
    const Vec3<Real> x = xyz(water.position[min(slot, model.particles - 1)]);
    const Real distance_squared = model.water.radius * model.water.radius;
    const unsigned own_lanes = kept_value(lanes, ((1u << pair_lanes) - 1) << first_lane);
    const unsigned lanes_before = kept_value(lanes, ((1u << lane) - 1) << first_lane);
    const unsigned last_copy = slots.water_room.copies - 1;
    const Vec4<Real>* const candidate = water.candidate;
    Candidates own{0, 0};
    int n = 0;
#pragma unroll 1
    for (int around = 0; around < rows; ++around) {
        if (around % pair_lanes == 0 && wanted) own = candidates_around(model, slots, x, min(around + lane, rows - 1));
        const int begin = __shfl_sync(lanes, own.begin, around % pair_lanes, pair_lanes);
        const int end = __shfl_sync(lanes, own.end, around % pair_lanes, pair_lanes);
        int left = max_of_slots(lanes, end - begin);
#pragma unroll unrolled
        for (int k = begin + lane; left > 0; left -= pair_lanes, k += pair_lanes) {
            const Vec4<Real> there = candidate[min(static_cast<unsigned>(k), last_copy)];
            const Real r2 = physics::squared_length(x - xyz(there));
            const bool near = k < end && r2 < distance_squared && r2 > 0;
            const unsigned found = __ballot_sync(lanes, near);
            keep(n, near, n + __popc(found & lanes_before), k, there);
            n += __popc(found & own_lanes);
        }
    }
    return n;
}

}  // namespace natator::cuda
