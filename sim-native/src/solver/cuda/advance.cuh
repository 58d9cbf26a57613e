#pragma once

#include "layout.cuh"
#include "update.cuh"

namespace natator::cuda {

/// Takes tickets until there are none. A ticket's State may still be in the hands of another block, which then works
/// on an earlier ticket: waiting cannot lock up.
template <class Real, Scheme scheme, bool on_chip>
__global__ void __launch_bounds__(threads, 1) advance(BatchView<Real> batch) {
    extern __shared__ __align__(32) char chip[];
    __shared__ unsigned ticket;
    Block<Real> block;
    Pieces on_chip_pieces(chip), in_scratch(batch.scratch + blockIdx.x * batch.scratch_bytes);
    place_on_chip(batch.model, on_chip, on_chip_pieces, block);
    place_in_scratch(batch.model, on_chip, in_scratch, block);
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
            update<scheme>(batch, state, number, block);
        __threadfence();
        __syncthreads();
        if (threadIdx.x == 0) *static_cast<volatile int*>(batch.updates_done + state) = number + 1;
    }
}

template <class Real, Scheme scheme>
const void* batch_kernel(bool on_chip) {
    return on_chip ? reinterpret_cast<const void*>(&advance<Real, scheme, true>)
                   : reinterpret_cast<const void*>(&advance<Real, scheme, false>);
}

}  // namespace natator::cuda
