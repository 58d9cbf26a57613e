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

/// What gives a free body the momentum back that its internal forces took: see cpu/conserving/velocities.cpp.
struct BodyMotion {
    double linear[3], angular[3], centre[3];
};

/// Where an observer's view of a State is written; null where nobody looks. By slot, with the particles' numbers.
template <class Real>
struct Trace {
    Quad<Real>* predicted = nullptr;  ///< [substep * particles + slot]
    Quad<Real>* iterated = nullptr;   ///< [(substep * iterations + iteration) * particles + slot]
    Quad<Real>* velocity = nullptr;   ///< [substep * particles + slot], at the slots of the last iteration
};

/// All that a block works on while it advances one State. Slots are numbered anew in every substep, as on the CPU:
/// first the fluid, then the solids, each in the order of its cells and within a cell by particle, so that the order,
/// and with it every sum, depends on positions alone.
template <class Real>
struct Block {
    // On the chip where they fit, by slot.
    Quad<Real>* position;  ///< w holds the particle's number as an integer
    Quad<Real>* next;      ///< positions after the iteration; cells and keys while slots are numbered
    Real* compression;     ///< of fluid slots; scheme conserving: lambda
    std::uint16_t* slot_of_solid;
    Real* rest_length;      ///< of the springs
    ClusterFit<Real>* fit;  ///< of the clusters
    int* scan;              ///< a number per warp
    int* touched_count;     ///< one number

    // In device memory, by slot.
    Quad<Real>* velocity;       ///< of the State
    Quad<Real>* next_velocity;  ///< what the substep makes of it
    Quad<Real>* predicted;      ///< scratch: predicted position before slots are numbered
    Quad<Real>* drift;          ///< v* after external forces, w = inverse mass
    Quad<Real>* drift_before;   ///< scratch: the same before slots are numbered
    Quad<Real>* start;          ///< position at the start of the substep
    std::uint16_t* neighbour;   ///< fluid neighbours of fluid slots: entry k of slot s at [k * fluid + s]
    std::uint16_t* neighbour_count;
    std::uint16_t* fluid_contact;  ///< solid neighbours of fluid slots, laid out likewise
    std::uint16_t* solid_contact;  ///< neighbours of solid slots: entry k of slot s at [k * solids + s - fluid]
    std::uint16_t* contact_count;  ///< by slot
    std::uint16_t* plane_contact;  ///< by slot: bit k set if plane k may be touched in this substep
    std::uint16_t* touched;        ///< slots that have contacts, in no order
    ClusterFit<Real>* fit_before;  ///< as the substep found them

    // In device memory, scheme conserving only, by slot unless said otherwise.
    Quad<Real>* base;          ///< predicted positions
    Quad<Real>* displacement;  ///< from base to the present position, apart so that it is not rounded to it
    Quad<Real>* boundary;      ///< grad_i C_i of planes and solids, w = what solids add to sum_k w_k |grad_k C_i|^2
    Real* lambda_sum;          ///< of the substep so far
    Real* overlap;             ///< C_i at the start of the substep if it is an overlap, else 0
    Real* overlap_lambda;      ///< what has pushed it out in this substep
    std::uint16_t* active;     ///< contacts that are not apart
    Quad<Real>* internal;      ///< by solid: its displacement by springs and clusters
    Quad<Real>* spring_push;   ///< by spring
    Real* spring_lambda;       ///< by spring
    Quad<Real>* member_displacement;  ///< by member of a cluster: sum of the substep's corrections
    Quad<Real>* member_push;          ///< by member of a cluster
    BodyMotion* motion;               ///< by free body

    Real h;            ///< substep, s
    bool overlapping;  ///< in this substep
    Trace<Real> trace;

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
