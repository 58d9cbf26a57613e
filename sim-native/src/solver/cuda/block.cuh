#pragma once

#include <cstdint>

#include "arrays.cuh"
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
#define NATATOR_OFFSET(type, name, count, place) unsigned name;
    NATATOR_BLOCK_ARRAYS(NATATOR_OFFSET)
#undef NATATOR_OFFSET
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
/// there.
template <class R, bool on_chip>
class Block {
public:
    using Real = R;

    __device__ Block(const Layout& layout, char* chip, char* scratch) : at_(layout), chip_(chip), scratch_(scratch) {}

    using Index = std::uint16_t;
    using Word = std::uint32_t;  // of two cells

#define NATATOR_ACCESSOR(type, name, count, place) \
    __device__ type* name() const { return reinterpret_cast<type*>(place() + at_.name); }
    NATATOR_BLOCK_ARRAYS(NATATOR_ACCESSOR)
#undef NATATOR_ACCESSOR
    __device__ Word* keys() const { return reinterpret_cast<Word*>(next()); }         ///< while slots are numbered
    __device__ Index* staging() const { return reinterpret_cast<Index*>(next()); }    ///< while pairs are searched
    __device__ Shared<Real>& shared() const { return *common(); }
    __device__ void book(Stage stage) const { shared().watch.book(stage); }

    // What a substep ends with; w of the position is its inverse mass.
    __device__ Quad<Real>* new_velocity() const { return next_velocity(); }
    __device__ Quad<Real>* end_position() const { return position(); }

    __device__ int staged() const { return at_.staged; }

    Quad<Real>* velocity = nullptr;  ///< of the State
    Real h = 0;                      ///< substep, s
    int phase = 0;                   ///< of for_each_unit

private:
    __device__ char* chip() const { return chip_; }
    __device__ char* scratch() const { return scratch_; }
    __device__ char* where_it_fits() const { return on_chip ? chip_ : scratch_; }

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
