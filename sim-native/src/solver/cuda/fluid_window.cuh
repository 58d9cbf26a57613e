#pragma once

// Where a team has many blocks, each that has fluid keeps on its chip what its sums read: the lists of its own slots, and the
// positions of the slots that these lists may name, its window. Slots lie by cells, so that the window of a row of slots
// is a run of them. From device memory every block would fetch its neighbours one by one, through caches that forget
// what they hold at every barrier.
#include <cstdio>
#include "contacts.cuh"

namespace natator::cuda {

/// Calls work(k) for k = 0 .. count - 1 by the threads of this block.
template <class Work>
__device__ void for_each_in_block(int count, const Work& work) {
#pragma unroll 1  // it seldom goes round twice
    for (int k = static_cast<int>(threadIdx.x); k < count; k += threads) work(k);
}

/// Sets what the slots of this block's window have on its chip: value_of(slot). Behind them is the far slot. Ends with a barrier of
/// the block.
template <class Real, class Team, class ValueOf>
__device__ void fill_window(const Team& team, Quad<Real>* window, const ValueOf& value_of) {
    const SlotRun run = team.window;
    const int count = run.end - run.begin;
#pragma unroll 1
    for (int k = static_cast<int>(threadIdx.x); k < count; k += 2 * threads) {  // two at a time under way
        const int second = min(k + threads, count - 1);
        const Quad<Real> one = value_of(run.begin + k), other = value_of(run.begin + second);
        window[k] = one;
        if (second == k + threads) window[second] = other;
    }
    if (threadIdx.x == 0) window[run.end - run.begin] = far_away<Real>();
    __syncthreads();
}
/// The same with what they have in an array of the team.
template <class Real, class Team>
__device__ void fetch_window(const Team& team, Quad<Real>* window, const Quad<Real>* from) {
    if (team.has_window()) fill_window(team, window, [&](int s) { return from[s]; });
}

/// The slots of this block's fluid: see for_each_unit and fluid_slot.
template <class Real, class Team>
__device__ SlotRun own_fluid(const ModelView<Real>& model, const Team& team) {
    const int units = fluid_units(model);
    const UnitRow row(team.block(), team.fluid_blocks(), units);
    const int end = (units - row.skipped) * 32;
    return {end - row.own * 32, min(end, model.fluid)};
}

/// Slots of the fluid in the cells around those of slots `own`.
template <class Real, class Team>
__device__ SlotRun slots_around(const ModelView<Real>& model, const Team& team, const SlotRun& own) {
    const GridView<Real>& grid = model.grid;
    const int reach = (grid.count[1] + 1) * grid.count[0] + grid.reach_x;
    const int low = grid.cell(xyz(team.position()[own.begin])) - reach, high = grid.cell(xyz(team.position()[own.end - 1])) + reach;
    return {low > 0 ? half_of(team.table(), low - 1) : 0, half_of(team.table(), min(high, grid.cells - 1))};
}

/// Puts this block's window where its slots are now, and fetches their positions. Has it too many for its chip, then it has
/// none, and works on device memory. Ends with a barrier of the block.
template <class Real, class Team>
__device__ void place_window(const ModelView<Real>& model, Team& team) {
    if (team.window_room() == 0) return;
    team.own = own_fluid(model, team);
    team.window = {0, 0};
    if (team.own.begin < team.own.end) {
        const SlotRun around = slots_around(model, team, team.own);
        if (around.end - around.begin < team.window_room()) team.window = around;
    }
    fetch_window(team, team.window_position(), team.position());
}

}  // namespace natator::cuda
