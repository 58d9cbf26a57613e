#pragma once

#include <cstdint>

#include "model_view.h"
#include "solver/stage.h"

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

/// Where an observer's view of a State is written; null where nobody looks. By slot, with the particles' numbers.
template <class Real>
struct Trace {
    Quad<Real>* predicted = nullptr;  ///< [substep * particles + slot]
    Quad<Real>* iterated = nullptr;   ///< [(substep * iterations + iteration) * particles + slot]
    Quad<Real>* velocity = nullptr;   ///< [substep * particles + slot], at the slots of the last iteration
};

/// Books a block's cycles on its stages, by its first thread; does nothing without totals.
struct Stopwatch {
    unsigned long long* totals;  ///< by Stage, of all blocks
    long long last;

    __device__ void start() {
        if (threadIdx.x == 0 && totals) last = clock64();
    }
    __device__ void book(Stage stage) {
        if (threadIdx.x != 0 || !totals) return;
        const long long now = clock64();
        atomicAdd(totals + static_cast<int>(stage), static_cast<unsigned long long>(now - last));
        last = now;
    }
};

/// Where in a block's memory its arrays begin, in bytes.
struct Layout {
    unsigned position, next, table, slot_of_solid, rest_length, fit, scan, shared;                     // on the chip
    unsigned state_velocity, next_velocity, predicted, drift, drift_before, start, number, neighbour;  // in scratch
    unsigned chunk_count, fluid_contact, solid_contact, contact_count, plane_contact, touched, contact_push, fit_before;
    unsigned density, overlaps, normal, curl;
    unsigned chip_bytes, scratch_bytes;
    int staged;  ///< neighbours per thread that `next` has room for while they are searched
};

/// Numbers that all threads of a block share.
template <class Real>
struct Shared {
    int touched;                         ///< slots that have contacts
    int next_unit[2];                    ///< of work that warps take as they get free, see for_each_unit
    Real solids_low[3], solids_high[3];  ///< box around the solids
    Stopwatch watch;
};

/// All that a block works on while it advances one State. Slots are numbered anew in every substep, as on the CPU:
/// first the fluid, then the solids, each in the order of its cells and within a cell by particle, so that the order,
/// and with it every sum, depends on positions alone. One more slot is far from all others: what ends lists points
/// there. Positions have the inverse mass in w, and are read from `position` and `next` in turn.
template <class R, bool on_chip>
class Block {
public:
    using Real = R;

    __device__ Block(const Layout& layout, char* chip, char* scratch) : at_(layout), chip_(chip), scratch_(scratch) {}

    // On the chip where they fit, by slot.
    __device__ Quad<Real>* position() const { return large<Quad<Real>>(at_.position); }
    __device__ Quad<Real>* next() const { return large<Quad<Real>>(at_.next); }
    __device__ std::uint32_t* keys() const { return large<std::uint32_t>(at_.next); }     ///< while slots are numbered
    __device__ std::uint16_t* staging() const { return large<std::uint16_t>(at_.next); }  ///< while pairs are searched
    __device__ std::uint32_t* table() const { return large<std::uint32_t>(at_.table); }   ///< two cells in each

    // On the chip.
    __device__ std::uint16_t* slot_of_solid() const { return on_the_chip<std::uint16_t>(at_.slot_of_solid); }
    __device__ Real* rest_length() const { return on_the_chip<Real>(at_.rest_length); }          ///< of the springs
    __device__ ClusterFit<Real>* fit() const { return on_the_chip<ClusterFit<Real>>(at_.fit); }  ///< of the clusters
    __device__ int* scan() const { return on_the_chip<int>(at_.scan); }                          ///< one per warp
    __device__ Shared<Real>& shared() const { return *on_the_chip<Shared<Real>>(at_.shared); }
    __device__ void book(Stage stage) const { shared().watch.book(stage); }

    // In device memory, by slot.
    __device__ Quad<Real>* next_velocity() const { return in_scratch<Quad<Real>>(at_.next_velocity); }
    __device__ Quad<Real>* predicted() const { return in_scratch<Quad<Real>>(at_.predicted); }  ///< w: its number
    __device__ Quad<Real>* drift() const { return in_scratch<Quad<Real>>(at_.drift); }  ///< v* after external forces
    __device__ Quad<Real>* drift_before() const { return in_scratch<Quad<Real>>(at_.drift_before); }
    __device__ Quad<Real>* start() const { return in_scratch<Quad<Real>>(at_.start); }  ///< w as in position
    __device__ std::uint16_t* number() const { return in_scratch<std::uint16_t>(at_.number); }
    /// Fluid neighbours of fluid slots, eight in one: chunk c of slot s at [c * fluid + s].
    __device__ uint4* neighbour() const { return in_scratch<uint4>(at_.neighbour); }
    __device__ std::uint16_t* neighbour_count() const { return in_scratch<std::uint16_t>(at_.chunk_count); }
    /// Solid neighbours of fluid slots: entry k of slot s at [k * fluid + s].
    __device__ std::uint16_t* fluid_contact() const { return in_scratch<std::uint16_t>(at_.fluid_contact); }
    /// Neighbours of solid slots: entry k of slot s at [k * solids + s - fluid].
    __device__ std::uint16_t* solid_contact() const { return in_scratch<std::uint16_t>(at_.solid_contact); }
    __device__ std::uint16_t* contact_count() const { return in_scratch<std::uint16_t>(at_.contact_count); }
    /// Bit k set if plane k may be touched in this substep.
    __device__ std::uint16_t* plane_contact() const { return in_scratch<std::uint16_t>(at_.plane_contact); }
    __device__ std::uint16_t* touched() const { return in_scratch<std::uint16_t>(at_.touched); }  ///< in no order
    /// What its contacts push a slot by; w: how many they are.
    __device__ Quad<Real>* contact_push() const { return in_scratch<Quad<Real>>(at_.contact_push); }
    __device__ ClusterFit<Real>* fit_before() const { return in_scratch<ClusterFit<Real>>(at_.fit_before); }

    // In device memory, by slot, each where an effect needs it.
    __device__ Real* density() const { return in_scratch<Real>(at_.density); }    ///< in units of rest density
    __device__ Real* overlaps() const { return in_scratch<Real>(at_.overlaps); }  ///< contacts that are, when predicted
    __device__ Quad<Real>* normal() const { return in_scratch<Quad<Real>>(at_.normal); }
    __device__ Quad<Real>* curl() const { return in_scratch<Quad<Real>>(at_.curl); }

    // What a substep ends with; w of the position is its inverse mass.
    __device__ Quad<Real>* new_velocity() const { return next_velocity(); }
    __device__ Quad<Real>* end_position() const { return position(); }

    __device__ int staged() const { return at_.staged; }

    Quad<Real>* velocity = nullptr;  ///< of the State
    Real h = 0;                      ///< substep, s
    int phase = 0;                   ///< of for_each_unit

private:
    template <class T>
    __device__ T* on_the_chip(unsigned offset) const {
        return reinterpret_cast<T*>(chip_ + offset);
    }
    template <class T>
    __device__ T* in_scratch(unsigned offset) const {
        return reinterpret_cast<T*>(scratch_ + offset);
    }
    template <class T>
    __device__ T* large(unsigned offset) const {
        if constexpr (on_chip)
            return on_the_chip<T>(offset);
        else
            return in_scratch<T>(offset);
    }

    const Layout& at_;
    char* chip_;
    char* scratch_;
};

/// Calls work(unit) for the units 0 .. count - 1, each by one whole warp that is free. Every thread of the block calls
/// it; a barrier must lie between two calls.
template <class Block, class Work>
__device__ void for_each_unit(Block& block, int count, const Work& work) {
    auto& shared = block.shared();
    const int turn = block.phase & 1;
    block.phase ^= 1;
    if (threadIdx.x == 0) shared.next_unit[turn ^ 1] = 0;  // for the next call; nobody uses it any more
    for (;;) {
        int unit = 0;
        if (threadIdx.x % 32 == 0) unit = atomicAdd(&shared.next_unit[turn], 1);
        unit = __shfl_sync(0xffffffff, unit, 0);
        if (unit >= count) return;
        work(unit);
    }
}

/// The sum over a warp, the same in all of its threads.
__device__ inline double sum_of_warp(double value) {
    for (int step = 16; step > 0; step /= 2) value += __shfl_xor_sync(0xffffffff, value, step);
    return value;
}

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

/// Cells' counts and bounds are kept two in a word.
__device__ inline int half_of(const std::uint32_t* table, int cell) {
    return reinterpret_cast<const std::uint16_t*>(table)[cell];
}
/// Adds 1 to a cell and returns what it held.
__device__ inline int count_up(std::uint32_t* table, int cell) {
    const int shift = cell % 2 * 16;
    return (atomicAdd(table + cell / 2, 1u << shift) >> shift) & 0xffff;
}

/// Replaces the cells' counts by the sums of all before each; every thread of the block calls it. `scan` has a number
/// per warp. Ends with a barrier.
__device__ inline void exclusive_scan(std::uint32_t* table, int count, int* scan) {
    const int words = (count + 1) / 2;
    const int share = (words + threads - 1) / threads;
    const int begin = min(static_cast<int>(threadIdx.x) * share, words), end = min(begin + share, words);
    std::uint32_t sum = 0;
    for (int i = begin; i < end; ++i) sum += (table[i] & 0xffff) + (table[i] >> 16);
    const int lane = threadIdx.x % 32, warp = threadIdx.x / 32;
    std::uint32_t inclusive = sum;
    for (int step = 1; step < 32; step *= 2) {
        const std::uint32_t before = __shfl_up_sync(0xffffffff, inclusive, step);
        if (lane >= step) inclusive += before;
    }
    if (lane == 31) scan[warp] = static_cast<int>(inclusive);
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
    std::uint32_t before = static_cast<std::uint32_t>(scan[warp]) + inclusive - sum;
    for (int i = begin; i < end; ++i) {
        const std::uint32_t word = table[i];
        const std::uint32_t second = before + (word & 0xffff);
        table[i] = before | second << 16;
        before = second + (word >> 16);
    }
    __syncthreads();
}

}  // namespace natator::cuda
