#pragma once

#include "update.cuh"

namespace natator::cuda {

/// A team takes tickets until there are none. A ticket's State may still be in the hands of another team, which then
/// works on an earlier ticket: waiting cannot lock up.
template <class Real, TeamKind kind, bool effects>
__global__ void __launch_bounds__(threads_of(kind), 1) advance(const __grid_constant__ BatchView<Real> batch) {
    extern __shared__ __align__(128) char chip[];
    using Team = StateTeam<Real, kind>;
    const std::size_t scratch = blockIdx.y * std::size_t{batch.layout.scratch_bytes};
    Team team(batch.layout, chip, batch.scratch + scratch, batch.arrivals + arrivals_of_team * blockIdx.y);
    auto& shared = team.shared();
    if (team.thread() == 0) shared.watch.totals = batch.profile;
    if (threadIdx.x == 0) team.of_block().next_task[0] = team.of_block().next_task[1] = 0;
    clear_cells(batch.model, team);
    const unsigned all = static_cast<unsigned>(batch.states) * batch.updates;
    for (;;) {
        const auto state_of = [&](unsigned ticket) { return static_cast<int>(ticket % batch.states); };
        const auto number_of = [&](unsigned ticket) { return static_cast<int>(ticket / batch.states); };
        if (team.thread() == 0) {
            const unsigned ticket = atomicAdd(batch.next_ticket, 1u);
            shared.ticket = ticket;
            while (ticket < all &&
                   *static_cast<volatile int*>(batch.updates_done + state_of(ticket)) < number_of(ticket))
                __nanosleep(100);
            __threadfence();
        }
        team.barrier();
        const unsigned mine = shared.ticket;
        if (mine >= all) return;
        const int state = state_of(mine), number = number_of(mine);
        if (*static_cast<volatile int*>(&batch.progress[state].stopped) < 0)
            update<effects>(batch, state, number, team);
        __threadfence();
        team.barrier();
        if (team.thread() == 0) *static_cast<volatile int*>(batch.updates_done + state) = number + 1;
    }
}

template <class Real, bool effects>
const void* batch_kernel(TeamKind kind) {
    if (kind == TeamKind::blocks) return reinterpret_cast<const void*>(&advance<Real, TeamKind::blocks, effects>);
    if constexpr (!effects) {
        if (kind == TeamKind::block) return reinterpret_cast<const void*>(&advance<Real, TeamKind::block, effects>);
        if constexpr (std::is_same_v<Real, float>)
            return reinterpret_cast<const void*>(&advance<Real, TeamKind::many_blocks, effects>);
    }
    return nullptr;
}

}  // namespace natator::cuda
