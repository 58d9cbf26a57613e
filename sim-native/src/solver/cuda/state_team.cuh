#pragma once

#include <cstdint>
#include <type_traits>

#include "arrays.cuh"
#include "model_view.h"
#include "solver/stage.h"
#include "team.cuh"

namespace natator::cuda {

/// Cluster as the last fit left it: centre, rotation matrix of the fit, and the quaternion that the next one starts
/// from.
template <class Real>
struct ClusterFit {
    Vec3<Real> centre;
    Real matrix[9];
    Real rotation[4];  ///< x, y, z, w
};

/// A spring on the chip, as one of its ends sees it.
template <class Real>
struct ChipSpring {
    int other;  ///< solid id
    Real rest_length;
    physics::SpringRule<Real> rule;
};

/// Arrays that an observer's view of a State is written to; null without an observer. By slot, with the particles'
/// numbers.
template <class Real>
struct Trace {
    Vec4<Real>* predicted = nullptr;  ///< [substep * particles + slot]
    Vec4<Real>* iterated = nullptr;   ///< [(substep * iterations + iteration) * particles + slot]
    Vec4<Real>* velocity = nullptr;   ///< [substep * particles + slot], at the slots of the last iteration
};

inline constexpr int pair_lanes = 8;  ///< threads that share the pairs of a slot
inline constexpr int slots_of_warp = 32 / pair_lanes;
inline constexpr int slot_lanes = 4;  ///< threads that share a slot of the fluid, see shared_slots.cuh
inline constexpr int shared_slots_of_warp = 32 / slot_lanes;
inline constexpr int max_contact_slots_on_chip = 32;  ///< slots
inline constexpr int max_listed_on_chip = 32;         ///< neighbours of a slot, or contacts

/// Slots one behind the other.
struct SlotRun {
    int begin, end;
};

/// Books a team's cycles on its stages, by its first thread; does nothing without totals.
struct Stopwatch {
    unsigned long long* totals;  ///< by Stage, of all teams
    long long last;

    __device__ void start(int thread) {
        if (thread == 0 && totals) last = clock64();
    }
    __device__ void book(Stage stage, int thread) {
        if (thread != 0 || !totals) return;
        const long long now = clock64();
        atomicAdd(totals + static_cast<int>(stage), static_cast<unsigned long long>(now - last));
        last = now;
    }
};

/// Offsets of a team's arrays in its memory, bytes.
struct Layout {
#define NATATOR_OFFSET(type, name, count, place) unsigned name;
    NATATOR_TEAM_ARRAYS(NATATOR_OFFSET)
#undef NATATOR_OFFSET
    unsigned chip_bytes, scratch_bytes;
    bool splits_solids;  ///< one of the team's blocks has the solids on its chip
    int slots_of_block;  ///< of the fluid, where threads share slots
    int staged;          ///< neighbours that a thread has room for while it searches them
};

/// Numbers that all threads share which work on a State.
template <class Real>
struct Shared {
    int contact_slot_count;              ///< slots that have contacts
    Real solids_low[3], solids_high[3];  ///< box around the solids
};

/// Values that the threads of a team share.
template <class Real>
struct SharedByTeam : Shared<Real> {
    int near;                            ///< slots of the fluid that may have contacts, where threads share slots
    int flags[2];                        ///< of GridTeam::any
    int block_sums[max_blocks_of_team];  ///< of exclusive_scan
    unsigned ticket;                     ///< that the team works on
    Stopwatch watch;
};

/// Numbers that the threads of one of a team's blocks share, on the chip.
struct SharedByBlock {
    int next_task[2];  ///< of work that warps take as they get free, see for_each_warp_task
    int sums[32];      ///< of sum_before
};

/// A team and all that it works on while it advances one State: a block that has the State on its chip, or several
/// blocks, which have it in device memory. Slots are numbered anew in every substep, as on the CPU: first the fluid,
/// then the solids, each in the order of its cells and within a cell by particle, so that the order, and with it every
/// sum, depends on positions alone. One more slot is far from all others: what ends lists points there.
template <class R, TeamKind kind>
class StateTeam : public std::conditional_t<kind == TeamKind::block, BlockTeam, GridTeam<kind>> {
    static constexpr bool on_chip = kind == TeamKind::block;

public:
    using Real = R;
    static constexpr int warps = StateTeam::threads / 32;
    static constexpr bool shares_slots = kind == TeamKind::many_blocks;  ///< several threads have a slot of the fluid

    /// `chip` is this block's own, `scratch` the team's.
    __device__ StateTeam(const Layout& layout, char* chip, char* scratch, unsigned* arrivals)
        : at_(layout), chip_(chip), scratch_(scratch) {
        if constexpr (StateTeam::of_several_blocks) this->begin(arrivals, shared().flags);
    }

    /// Has each solid several threads? Solids take longest, and several blocks would wait for them; one has enough to
    /// do meanwhile.
    __device__ static constexpr bool shares_solids() { return StateTeam::blocks() > 1; }

    /// Has one block the solids, and the others the fluid? It is the last.
    __device__ bool splits_solids() const { return shares_slots || (!on_chip && at_.splits_solids); }
    __device__ bool has_solids() const { return splits_solids() && StateTeam::block() == StateTeam::blocks() - 1; }

    // The threads that have springs and their lengths: of the block that has the solids, or all; other blocks call none
    // of these.
    __device__ int solid_thread() const {
        return splits_solids() ? static_cast<int>(threadIdx.x) : StateTeam::thread();
    }
    __device__ int solid_threads() const { return splits_solids() ? StateTeam::threads : StateTeam::size(); }
    __device__ void solid_barrier() const {
        if (splits_solids())
            __syncthreads();
        else
            StateTeam::barrier();
    }

    using Index = std::uint16_t;
    using Word = std::uint32_t;  // of two cells

#define NATATOR_ACCESSOR(type, name, count, place) \
    __device__ type* name() const { return reinterpret_cast<type*>(place() + at_.name); }
    NATATOR_TEAM_ARRAYS(NATATOR_ACCESSOR)
#undef NATATOR_ACCESSOR
    __device__ Word* cell_ends() const { return shares_slots ? chip_table() : table(); }  ///< once slots are numbered
    __device__ int slots_of_block() const { return at_.slots_of_block; }
    __device__ int first_slot() const { return StateTeam::block() * at_.slots_of_block; }  ///< of this block
    __device__ Word* keys() const { return reinterpret_cast<Word*>(scratch_position()); }  ///< while slots are numbered
    /// While pairs are searched, entry k of a thread of this block at [k * threads + its number in the block].
    __device__ Index* staging() const { return on_chip ? reinterpret_cast<Index*>(scratch_position()) : own_staging(); }
    __device__ SharedByTeam<Real>& shared() const { return *shared_by_team(); }
    __device__ SharedByBlock& of_block() const { return *shared_by_block(); }
    __device__ void book(Stage stage) const { shared().watch.book(stage, this->thread()); }

    // What a substep ends with; w of the position is its inverse mass.
    __device__ Vec4<Real>* new_velocity() const { return scratch_velocity(); }
    __device__ Vec4<Real>* end_position() const { return position(); }
    __device__ Vec4<Real>* predicted_position() const { return position(); }  ///< while pairs are searched

    __device__ int staged() const { return at_.staged; }

    Vec4<Real>* velocity = nullptr;  ///< of the State
    Real h = 0;                      ///< substep, s
    int phase = 0;                   ///< of for_each_warp_task

private:
    __device__ char* block_chip() const { return chip_; }
    __device__ char* team() const { return on_chip ? chip_ : scratch_; }
    __device__ char* scratch() const { return scratch_; }

    const Layout& at_;
    char* chip_;
    char* scratch_;
};

/// Calls work(task) for the tasks 0 .. few + many - 1, each by one whole warp. Of the first, which take long, a block
/// of the team has every so many-th; of the others, which lie side by side in the tank, a row. Each of its warps begins
/// with one of them and takes more as it gets free. Every thread of the first `blocks` blocks calls it, of all if none
/// are named; a barrier must lie between two calls.
template <class Team, class Work>
__device__ void for_each_warp_task(Team& team, int blocks, int few, int many, const Work& work) {
    const int own_few = (few - team.block() + blocks - 1) / blocks;
    const int row = (many + blocks - 1) / blocks;
    const int skipped = team.block() * row, own = own_few + max(min(row, many - skipped), 0);
    int* const next_task = team.of_block().next_task;
    const int turn = team.phase & 1;
    team.phase ^= 1;
    if (threadIdx.x == 0) next_task[turn ^ 1] = 0;  // for the next call; nobody uses it any more
    for (int task = threadIdx.x / 32; task < own;) {
        work(task < own_few ? task * blocks + team.block() : few + skipped + task - own_few);
        if (own <= Team::warps) return;
        if (threadIdx.x % 32 == 0) task = Team::warps + atomicAdd(&next_task[turn], 1);
        task = __shfl_sync(0xffffffff, task, 0);
    }
}

template <class Team, class Work>
__device__ void for_each_warp_task(Team& team, int few, int many, const Work& work) {
    for_each_warp_task(team, team.blocks(), few, many, work);
}

/// Tasks of 32 slots that the fluid makes.
template <class Real>
__host__ __device__ int fluid_tasks(const ModelView<Real>& model) {
    return (model.fluid + 31) / 32;
}

/// This lane's slot in task k of the fluid's, which go from the last slots to the first: 3 % faster for batches on an
/// H100 than the other way.
__device__ inline int fluid_slot(int task, int tasks) {
    return (tasks - 1 - task) * 32 + static_cast<int>(threadIdx.x) % 32;
}

/// The sum over a warp, the same in all of its threads.
template <class T>
__device__ T sum_of_warp(T value) {
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

/// The sum of the values of the threads before this one in its block; `total` gets that of all of them.
template <int warps>
__device__ int sum_before(int value, int* sums_of_warps, int& total) {
    const int lane = threadIdx.x % 32, warp = threadIdx.x / 32;
    const auto sum_up_to_lane = [lane](int sum) {
        for (int step = 1; step < 32; step *= 2) {
            const int before = __shfl_up_sync(0xffffffff, sum, step);
            if (lane >= step) sum += before;
        }
        return sum;
    };
    const int of_warp = sum_up_to_lane(value);
    if (lane == 31) sums_of_warps[warp] = of_warp;
    __syncthreads();
    if (warp == 0) {
        const int own = lane < warps ? sums_of_warps[lane] : 0, up_to = sum_up_to_lane(own);
        sums_of_warps[lane] = up_to - own;
        if (lane == 31) total = up_to;
    }
    __syncthreads();
    return sums_of_warps[warp] + of_warp - value;
}

/// Replaces the cells' counts by the sums of all before each; every thread of the team calls it. Ends with a barrier.
template <class Team>
__device__ void exclusive_scan(const Team& team, std::uint32_t* table, int count) {
    const int words = (count + 1) / 2;
    const int share = (words + team.size() - 1) / team.size();
    const int begin = min((team.block() * Team::threads + static_cast<int>(threadIdx.x)) * share, words);
    const int end = min(begin + share, words);
    std::uint32_t sum = 0;
    for (int i = begin; i < end; ++i) sum += (table[i] & 0xffff) + (table[i] >> 16);
    int* const block_sums = team.shared().block_sums;
    auto before = static_cast<std::uint32_t>(
        sum_before<Team::warps>(static_cast<int>(sum), team.of_block().sums, block_sums[team.block()]));
    if constexpr (Team::of_several_blocks) {
        team.barrier();
        unsigned of_blocks = 0;
        for (int b = static_cast<int>(threadIdx.x) % 32; b < team.block(); b += 32)
            of_blocks += static_cast<unsigned>(block_sums[b]);
        before += sum_of_warp(of_blocks);
    }
    for (int i = begin; i < end; ++i) {
        const std::uint32_t word = table[i];
        const std::uint32_t second = before + (word & 0xffff);
        table[i] = before | second << 16;
        before = second + (word >> 16);
    }
    team.barrier();
}

}  // namespace natator::cuda
