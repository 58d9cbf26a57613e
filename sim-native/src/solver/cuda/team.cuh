#pragma once

namespace natator::cuda {

inline constexpr int max_blocks_of_team = 144;

/// The threads that advance a State: those of a block that has it on its chip, of several blocks that have it in device
/// memory, or of so many that several threads share each slot of the fluid.
enum class TeamKind { block, blocks, many_blocks };

/// Number of threads of a block in a team of several blocks. Where blocks have little to do, fewer wait for each other,
/// and each has more registers.
constexpr int threads_of(TeamKind kind) {
    return kind == TeamKind::many_blocks ? 512 : 1024;
}

/// The threads that advance one State: a block's. The code of a State's stages knows no more of threads than this. All
/// of them call barrier() and any().
struct BlockTeam {
    static constexpr bool of_several_blocks = false;
    static constexpr int threads = threads_of(TeamKind::block);  ///< of a block

    __device__ static int thread() { return static_cast<int>(threadIdx.x); }
    __device__ static constexpr int size() { return threads; }
    __device__ static constexpr int blocks() { return 1; }
    __device__ static constexpr int block() { return 0; }
    __device__ static void barrier() { __syncthreads(); }
    /// Is it true for any of the threads? A barrier, too.
    __device__ static bool any(bool value) { return __syncthreads_or(value); }
};

/// Counts blocks of a team that have reached a point where others wait for them.
class Arrivals {
public:
    __device__ void begin(unsigned* count) { count_ = count; }
    /// Says that this block has arrived: what its threads wrote before a barrier of the block is seen by all who wait.
    __device__ void add() const {
        if (threadIdx.x == 0) asm volatile("red.release.gpu.global.add.u32 [%0], 1;" ::"l"(count_) : "memory");
    }
    /// Raises the count that is waited for.
    __device__ void expect(int blocks) const { expected_ += static_cast<unsigned>(blocks); }
    /// A barrier of the block, too.
    __device__ void wait() const {
        if (threadIdx.x == 0) {
            unsigned seen;
            do asm volatile("ld.acquire.gpu.global.u32 %0, [%1];" : "=r"(seen) : "l"(count_) : "memory");
            while (static_cast<int>(seen - expected_) < 0);
        }
        __syncthreads();
    }

private:
    unsigned* count_ = nullptr;
    mutable unsigned expected_ = 0;
};
inline constexpr int arrivals_of_team = 64;  ///< numbers of a team's Arrivals, on cache lines of their own

/// The threads of several blocks, which are all on the device at a time: a row of the grid. The warps of the blocks are
/// numbered in turn, so that little work is spread over all of them.
template <TeamKind kind>
class GridTeam {
public:
    static constexpr bool of_several_blocks = true;
    static constexpr int threads = threads_of(kind);

    GridTeam() = default;
    GridTeam(const GridTeam&) = delete;  // each counts the barriers
    GridTeam& operator=(const GridTeam&) = delete;

    __device__ static int thread() {
        return (static_cast<int>(threadIdx.x) / 32 * blocks() + block()) * 32 + static_cast<int>(threadIdx.x) % 32;
    }
    __device__ static int size() { return blocks() * threads; }
    __device__ static int blocks() { return static_cast<int>(gridDim.x); }
    __device__ static int block() { return static_cast<int>(blockIdx.x); }
    /// Before the first barrier: `arrivals` are 0, `flags` room. Ends with a barrier.
    __device__ void begin(unsigned* arrivals, int* flags) {
        all_.begin(arrivals);
        others_.begin(arrivals + arrivals_of_team / 2);
        flags_ = flags;
        if (thread() == 0) flags[0] = flags[1] = 0;
        barrier();
    }
    /// What a thread of the team has written before it is seen by all behind it.
    __device__ void barrier() const {
        arrive();
        if (blocks() > 1) wait();
    }
    // The same in halves, for a block that goes on meanwhile. A wait without an arrival is for what has been waited for
    // already, too.
    __device__ void arrive() const {
        __syncthreads();
        if (blocks() == 1) return;
        all_.add();
        all_.expect(blocks());
    }
    __device__ void wait() const { all_.wait(); }
    /// A barrier of all blocks but the last, which waits by wait_for_others().
    __device__ void barrier_of_others() const {
        __syncthreads();
        others_.add();
        wait_for_others();
    }
    __device__ void wait_for_others() const {
        others_.expect(blocks() - 1);
        others_.wait();
    }
    /// Of two flags that begin with 0, each call sets the one that the call before it does not read.
    __device__ bool any(bool value) const {
        const bool in_block = __syncthreads_or(value);
        if (blocks() == 1) return in_block;
        int& flag = flags_[++calls_ % 2];
        if (in_block && threadIdx.x == 0) atomicExch(&flag, calls_);
        barrier();
        return flag == calls_;
    }

private:
    Arrivals all_, others_;
    int* flags_ = nullptr;
    mutable int calls_ = 0;
};

}  // namespace natator::cuda
