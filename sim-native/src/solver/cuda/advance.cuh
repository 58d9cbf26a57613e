#pragma once

#include "update.cuh"

namespace natator::cuda {

/// A team takes tickets until there are none. A ticket's State may still be in the hands of another team, which then works
/// on an earlier ticket: waiting cannot lock up.
template <class Real, bool on_chip, bool effects>
__global__ void __launch_bounds__(threads, 1) advance(const __grid_constant__ BatchView<Real> batch) {
    extern __shared__ __align__(128) char chip[];
    using Team = StateTeam<Real, on_chip>;
    const std::size_t scratch = blockIdx.x / Team::blocks() * std::size_t{batch.layout.scratch_bytes};
    Team team(batch.layout, chip, batch.scratch + scratch);
    auto& shared = team.shared();
    if (team.thread() == 0) shared.watch.totals = batch.profile;
    if (threadIdx.x == 0) team.of_block().next_unit[0] = team.of_block().next_unit[1] = 0;
    for (;;) {
        if (team.thread() == 0) shared.ticket = atomicAdd(batch.next_ticket, 1u);
        team.barrier();
        const unsigned mine = shared.ticket;
        if (mine >= static_cast<unsigned>(batch.states) * batch.updates) return team.leave();
        const int state = mine % batch.states, number = mine / batch.states;
        if (team.thread() == 0) {
            while (*static_cast<volatile int*>(batch.updates_done + state) < number) __nanosleep(100);
            __threadfence();
        }
        team.barrier();
        if (*static_cast<volatile int*>(&batch.progress[state].stopped) < 0)
            update<effects>(batch, state, number, team);
        __threadfence();
        team.barrier();
        if (team.thread() == 0) *static_cast<volatile int*>(batch.updates_done + state) = number + 1;
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
