#pragma once

// Sums of several values over a warp at once: the bits of sum_of_warp for each, by fewer shuffles. In every step two
// lanes share the values that they both have, so that in the end each lane has the sum of one.

namespace natator::cuda {

/// Which of `count` values a lane has the sum of in the end; -1 if of none.
template <int count, int step = 16>
__host__ __device__ constexpr int value_of_lane(int lane) {
    if constexpr (step == 0) {
        return 0;
    } else if constexpr (count == 1) {
        return value_of_lane<1, step / 2>(lane);
    } else {
        constexpr int kept = (count + 1) / 2;
        const int of_kept = value_of_lane<kept, step / 2>(lane);
        const int value = (lane & step) != 0 ? kept + of_kept : of_kept;
        return of_kept < 0 || value >= count ? -1 : value;
    }
}

/// The first lane that has the sum of a value.
template <int count>
__host__ __device__ constexpr int lane_of_value(int value) {
    int lane = 0;
    while (value_of_lane<count>(lane) != value) ++lane;
    return lane;
}

/// The sum of value value_of_lane<count>(lane) over the warp.
template <int count, int step = 16>
__device__ double share_sums_of_warp(const double (&values)[count], int lane) {
    if constexpr (step == 0) {
        return values[0];
    } else if constexpr (count == 1) {
        const double sum[1] = {values[0] + __shfl_xor_sync(0xffffffff, values[0], step)};
        return share_sums_of_warp<1, step / 2>(sum, lane);
    } else {
        constexpr int kept = (count + 1) / 2;
        const bool upper = (lane & step) != 0;
        double sums[kept];
#pragma unroll
        for (int e = 0; e < kept; ++e) {
            const double low = values[e], high = kept + e < count ? values[kept + e] : 0;
            sums[e] = (upper ? high : low) + __shfl_xor_sync(0xffffffff, upper ? low : high, step);
        }
        return share_sums_of_warp<kept, step / 2>(sums, lane);
    }
}

/// For all lanes what the first one that has value number `value` of `count` has.
template <int count>
__device__ double of_value(double own, int value) {
    return __shfl_sync(0xffffffff, own, lane_of_value<count>(value));
}

}  // namespace natator::cuda
