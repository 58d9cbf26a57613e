#pragma once

#include <cstdint>

#include "model_view.h"

namespace natator::cuda {

inline constexpr int threads = 1024;  ///< of the block that advances one State
inline constexpr int warps = threads / 32;

/// Cluster as the last fit left it: centre, rotation matrix of the fit, and the quaternion that the next one starts
/// from.
template <class Real>
struct ClusterFit {
    Vec3<Real> centre;
    Real matrix[9];
    Real rotation[4];  ///< x, y, z, w
};

/// All that a block works on while it advances one State. Slots are numbered anew in every substep, as on the CPU:
/// first the fluid, then the solids, each in the order of its cells and within a cell by particle, so that the order,
/// and with it every sum, depends on positions alone.
template <class Real>
struct Block {
    // On the chip where they fit, by slot.
    Quad<Real>* position;  ///< w holds the particle's number as an integer
    Quad<Real>* next;      ///< positions after the iteration; cells and keys while slots are numbered
    Real* compression;     ///< of fluid slots
    std::uint16_t* slot_of_solid;
    Real* rest_length;      ///< of the springs
    ClusterFit<Real>* fit;  ///< of the clusters
    int* scan;              ///< a number per warp

    // In device memory, by slot.
    Quad<Real>* velocity;      ///< of the State
    Quad<Real>* predicted;     ///< scratch: predicted position before slots are numbered
    Quad<Real>* drift;         ///< v* after external forces, w = inverse mass
    Quad<Real>* drift_before;  ///< scratch: the same before slots are numbered
    Quad<Real>* start;         ///< position at the start of the substep
    std::uint16_t* neighbour;  ///< fluid neighbours of fluid slots: entry k of slot s at [k * fluid + s]
    std::uint16_t* neighbour_count;
    std::uint16_t* fluid_contact;  ///< solid neighbours of fluid slots, laid out likewise
    std::uint16_t* solid_contact;  ///< neighbours of solid slots: entry k of slot s at [k * solids + s - fluid]
    std::uint16_t* contact_count;  ///< by slot
    std::uint16_t* plane_contact;  ///< by slot: bit k set if plane k may be touched in this substep

    Real h;  ///< substep, s

    __device__ int* cell_table() const { return reinterpret_cast<int*>(next); }
    __device__ std::uint32_t* keys(int cells) const {
        return reinterpret_cast<std::uint32_t*>(cell_table() + 2 * cells);
    }
};

__device__ inline int number_in(float w) {
    return __float_as_int(w);
}
__device__ inline int number_in(double w) {
    return static_cast<int>(__double_as_longlong(w));
}
template <class Real>
__device__ Real as_number(int i);
template <>
__device__ inline float as_number<float>(int i) {
    return __int_as_float(i);
}
template <>
__device__ inline double as_number<double>(int i) {
    return __longlong_as_double(i);
}

/// Replaces values[0..count) by the sums of all before each; every thread of the block calls it. `scan` has a number
/// per warp. Ends with a barrier.
__device__ inline void exclusive_scan(int* values, int count, int* scan) {
    const int share = (count + threads - 1) / threads;
    const int begin = min(static_cast<int>(threadIdx.x) * share, count), end = min(begin + share, count);
    int sum = 0;
    for (int i = begin; i < end; ++i) sum += values[i];
    const int lane = threadIdx.x % 32, warp = threadIdx.x / 32;
    int inclusive = sum;
    for (int step = 1; step < 32; step *= 2) {
        const int before = __shfl_up_sync(0xffffffff, inclusive, step);
        if (lane >= step) inclusive += before;
    }
    if (lane == 31) scan[warp] = inclusive;
    __syncthreads();
    if (warp == 0) {
        const int total = lane < warps ? scan[lane] : 0;
        int up_to = total;
        for (int step = 1; step < 32; step *= 2) {
            const int before = __shfl_up_sync(0xffffffff, up_to, step);
            if (lane >= step) up_to += before;
        }
        if (lane < warps) scan[lane] = up_to - total;
    }
    __syncthreads();
    int before = scan[warp] + inclusive - sum;
    for (int i = begin; i < end; ++i) {
        const int value = values[i];
        values[i] = before;
        before += value;
    }
    __syncthreads();
}

}  // namespace natator::cuda
