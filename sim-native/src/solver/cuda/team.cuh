#pragma once

#include <cooperative_groups.h>

#include <cstdint>

namespace natator::cuda {

inline constexpr int threads = 1024;  ///< of a block that advances a State, alone or with others
inline constexpr int warps = threads / 32;
inline constexpr int most_blocks_of_team = 16;  ///< of a thread-block cluster on an H100

/// The threads that advance one State: a block's. The code of a State's stages knows no more of threads than this. All
/// of them call barrier() and any().
struct BlockTeam {
    static constexpr bool of_several_blocks = false;

    __device__ static int thread() { return static_cast<int>(threadIdx.x); }
    __device__ static constexpr int size() { return threads; }
    __device__ static constexpr int blocks() { return 1; }
    __device__ static constexpr int block() { return 0; }
    __device__ static void barrier() { __syncthreads(); }
    /// Is it true for any of the threads? A barrier, too.
    __device__ static bool any(bool value) { return __syncthreads_or(value); }
};

/// The threads of the blocks of a thread-block cluster, so that one State has several multiprocessors. The warps of the
/// blocks are numbered in turn, so that little work is spread over all of them.
///
/// Its barrier is one of each block, then one of the blocks by a warp of each: in that of the cluster itself every warp waits
/// for what it has written and forgets what the multiprocessor has read.
class ClusterTeam {
public:
    static constexpr bool of_several_blocks = true;

    ClusterTeam() = default;
    ClusterTeam(const ClusterTeam&) = delete;  // each counts the barriers
    ClusterTeam& operator=(const ClusterTeam&) = delete;

    __device__ static int thread() {
        return (static_cast<int>(threadIdx.x) / 32 * blocks() + block()) * 32 + static_cast<int>(threadIdx.x) % 32;
    }
    __device__ static int size() { return blocks() * threads; }
#if __CUDA_ARCH__ >= 900
    __device__ static int blocks() { return static_cast<int>(cooperative_groups::this_cluster().num_blocks()); }
    __device__ static int block() { return static_cast<int>(cooperative_groups::this_cluster().block_rank()); }
    /// Before the first barrier and after the last: `arrivals` of this block and `flags` of the team are its room.
    __device__ void begin(std::uint64_t* arrivals, int* flags) {
        arrivals_ = static_cast<unsigned>(__cvta_generic_to_shared(arrivals));
        flags_ = flags;
        if (thread() == 0) flags[0] = flags[1] = 0;
        if (threadIdx.x == 0)
            asm volatile("mbarrier.init.shared::cta.b64 [%0], %1;" ::"r"(arrivals_), "r"(blocks()) : "memory");
        cooperative_groups::this_cluster().sync();
    }
    __device__ static void end() { cooperative_groups::this_cluster().sync(); }
    /// What a thread of the cluster has written before it is seen by all behind it.
    __device__ void barrier() const {
        __syncthreads();
        if (blocks() == 1) return;
        arrive();
        wait();
    }
    // The same in halves, for a block that has nothing to say and goes on meanwhile; the second is a barrier of the block, too.
    __device__ void arrive() const {
        if (static_cast<int>(threadIdx.x) < blocks()) arrive_at(threadIdx.x);
    }
    __device__ void wait() const {
        if (threadIdx.x < 32)
            while (!all_arrived(turn_)) {}
        turn_ ^= 1;
        __syncthreads();
    }
#else  // no clusters: each block is one by itself
    __device__ static int blocks() { return 1; }
    __device__ static int block() { return 0; }
    __device__ void begin(std::uint64_t*, int* flags) {
        flags_ = flags;
        if (threadIdx.x == 0) flags[0] = flags[1] = 0;
        __syncthreads();
    }
    __device__ static void end() {}
    __device__ static void barrier() { __syncthreads(); }
    __device__ static void arrive() {}
    __device__ static void wait() { __syncthreads(); }
#endif
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
#if __CUDA_ARCH__ >= 900
    __device__ void arrive_at(unsigned block) const {
        asm volatile(
            "{\n\t"
            ".reg .b32 there;\n\t"
            "mapa.shared::cluster.u32 there, %0, %1;\n\t"
            "mbarrier.arrive.release.cluster.shared::cluster.b64 _, [there];\n\t"
            "}" ::"r"(arrivals_),
            "r"(block)
            : "memory");
    }
    __device__ bool all_arrived(unsigned turn) const {
        int done = 0;
        asm volatile(
            "{\n\t"
            ".reg .pred done;\n\t"
            "mbarrier.try_wait.parity.acquire.cluster.shared::cta.b64 done, [%1], %2;\n\t"
            "selp.s32 %0, 1, 0, done;\n\t"
            "}"
            : "=r"(done)
            : "r"(arrivals_), "r"(turn)
            : "memory");
        return done != 0;
    }
#endif
    unsigned arrivals_ = 0;  ///< of blocks at the barrier: an mbarrier on the chip
    int* flags_ = nullptr;
    mutable unsigned turn_ = 0;
    mutable int calls_ = 0;
};

}  // namespace natator::cuda
