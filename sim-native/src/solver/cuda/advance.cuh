#pragma once

#include "update.cuh"

namespace natator::cuda {

/// Takes tickets until there are none. A ticket's State may still be in the hands of another block, which then works
/// on an earlier ticket: waiting cannot lock up.
template <class Real, bool on_chip, bool effects>
__global__ void __launch_bounds__(threads, 1) advance(const __grid_constant__ BatchView<Real> batch) {
    extern __shared__ __align__(128) char chip[];
    __shared__ unsigned ticket;
    Block<Real, on_chip> block(batch.layout, chip,
                               batch.scratch + blockIdx.x * std::size_t{batch.layout.scratch_bytes});
    if (threadIdx.x == 0) {
        block.shared().watch.totals = batch.profile;
        block.shared().next_unit[0] = block.shared().next_unit[1] = 0;
    }
    for (;;) {
        if (threadIdx.x == 0) ticket = atomicAdd(batch.next_ticket, 1u);
        __syncthreads();
        const unsigned mine = ticket;
        if (mine >= static_cast<unsigned>(batch.states) * batch.updates) return;
        const int state = mine % batch.states, number = mine / batch.states;
        if (threadIdx.x == 0) {
            while (*static_cast<volatile int*>(batch.updates_done + state) < number) __nanosleep(100);
            __threadfence();
        }
        __syncthreads();
        if (*static_cast<volatile int*>(&batch.progress[state].stopped) < 0)
            update<effects>(batch, state, number, block);
        __threadfence();
        __syncthreads();
        if (threadIdx.x == 0) *static_cast<volatile int*>(batch.updates_done + state) = number + 1;
    }
}

template <class Real, bool effects>
const void* batch_kernel(bool on_chip) {
    if constexpr (!effects) {
        if (on_chip) return reinterpret_cast<const void*>(&advance<Real, true, effects>);
    }
    return reinterpret_cast<const void*>(&advance<Real, false, effects>);
}

}  // namespace natator::cuda
