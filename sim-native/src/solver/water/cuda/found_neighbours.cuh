#pragma once

// Neighbours of the water that are searched anew in each sum over them: nothing is listed, which takes time and saves
// most of the memory. They come to the same threads in the same order as from lists, so that sums have the same bits:
// see water_neighbours.cuh.
#include "water_candidates.cuh"

namespace natator::cuda {

/// Neighbours of a slot that are found and not yet handed out; each slot of a block has room for so many, in banks of
/// its own.
inline constexpr int found_room = 64, found_stride = found_room + pair_lanes;

/// for_each_found by the threads of a warp that are in `lanes`; `found` is the room of the block's slots.
template <class Real, class Lanes, class Keep, class Visit>
__device__ int hand_out_found(const ModelView<Real>& model, const Slots<Real>& slots, int s, bool wanted, int residue,
                              Lanes lanes, unsigned* found, const Keep& keep, const Visit& visit) {
    found += kept_value(lanes, threadIdx.x / pair_lanes * found_stride);
    int handed_out = 0;
    const auto hand_out = [&](int n, int min_count) {
        __syncwarp(lanes);
        while (__any_sync(lanes, n - handed_out >= min_count)) {
            const int own = handed_out + residue;
            const bool enough = n - handed_out >= min_count;
            if (enough && own < n) visit(found[static_cast<unsigned>(own) % found_room]);
            if (enough) handed_out += pair_lanes;
        }
        __syncwarp(lanes);
    };
    const auto take = [&](int before, bool near, int n, int k, const Vec4<Real>& candidate) {
        if (__any_sync(lanes, before - handed_out > found_room - pair_lanes)) hand_out(before, pair_lanes);
        if (near) found[static_cast<unsigned>(n) % found_room] = keep(k, candidate);
    };
    constexpr int unrolled = 1;
    const int all = search_water<unrolled>(model, slots, s, wanted, lanes, take);
    hand_out(all, 1);
    return all;
}

/// Calls visit(what keep(k, candidate k) gave) for the neighbours n of slot s, candidates k, with n % pair_lanes ==
/// residue; for none if they are not `wanted`. The threads of all slots below `end` call it, those of a warp together.
/// Returns how many there are.
template <class Real, class Keep, class Visit>
__device__ int for_each_found(const ModelView<Real>& model, const Slots<Real>& slots, int s, int end, bool wanted,
                              int residue, const Keep& keep, const Visit& visit) {
    __shared__ unsigned room[grid_threads / pair_lanes * found_stride];
    const int first = s - static_cast<int>(threadIdx.x) % 32 / pair_lanes;  // of the warp
    if (first + slots_of_warp <= end)
        return hand_out_found(model, slots, s, wanted, residue, AllLanes(), room, keep, visit);
    const unsigned lanes = (1u << (end - first) * pair_lanes) - 1;
    return hand_out_found(model, slots, s, wanted, residue, lanes, room, keep, visit);
}

}  // namespace natator::cuda
