#pragma once

// The search of a team whose threads share slots (shared_slots.cuh), and what its blocks keep of it on their chips: the
// same lists as those of neighbours.cuh, in the same order.
#include "solver/cuda/neighbours.cuh"

namespace natator::cuda {

/// The value of lane k of every `lanes`.
template <int lanes, class T>
__device__ T of_lane(const T& value, int k) {
    static_assert(sizeof(T) % sizeof(int) == 0);
    T other;
#pragma unroll
    for (int word = 0; word < static_cast<int>(sizeof(T) / sizeof(int)); ++word)
        reinterpret_cast<int*>(&other)[word] =
            __shfl_sync(0xffffffff, reinterpret_cast<const int*>(&value)[word], k, lanes);
    return other;
}

/// Tasks of for_each_warp_task that the fluid makes, `lanes` threads for each slot.
template <int lanes, class Real>
__device__ int shared_fluid_tasks(const ModelView<Real>& model) {
    return (model.fluid * lanes + 31) / 32;
}
/// This lane's slot in such a task; -1 beyond the last.
template <int lanes, class Real>
__device__ int shared_fluid_slot(const ModelView<Real>& model, int task) {
    const int s = (task * 32 + static_cast<int>(threadIdx.x) % 32) / lanes;
    return s < model.fluid ? s : -1;
}

/// Lists the fluid neighbours of the slots in a task of this block's, the first of each on the chip.
template <class Real, class Team>
__device__ void list_fluid_neighbours_of_task(const ModelView<Real>& model, const Team& team, int task) {
    constexpr unsigned all_lanes = 0xffffffff;
    constexpr int rows = 3,
                  at_once = 2;  // of cells side by side, and slots of a run for each thread, that are fetched at a time
    const int s = shared_fluid_slot<pair_lanes>(model, task), there = s < 0 ? model.particles : s,
              own = s - team.first_slot();
    const int lane = static_cast<int>(threadIdx.x) % pair_lanes, first_lane = static_cast<int>(threadIdx.x) % 32 - lane;
    const Vec3<Real> x = xyz(team.predicted_position()[there]);
    const int i = model.plan.uniform_fluid ? 0 : team.number()[there];
    std::uint16_t* const list = team.chip_neighbour() + max_listed_on_chip * own;
    int n = 0;
    const auto look_at = [&](int other, const Vec4<Real>& at) {
        const bool found = is_near(model, x, at) &&
                           (model.plan.uniform_fluid || collides(model, i, static_cast<int>(team.number()[other])));
        const unsigned all_found = __ballot_sync(all_lanes, found) >> first_lane & 0xff;
        const int place = n + __popc(all_found & ((1u << lane) - 1));
        if (found && place < max_listed_on_chip) list[place] = static_cast<std::uint16_t>(other);
        if (found && place >= max_listed_on_chip && place < model.max_neighbours)
            list_entry(model, team, s, place) = static_cast<std::uint16_t>(other);
        n += __popc(all_found);
    };
    // A run for each thread, and the last.
    const auto run_of = [&](int k) { return slots_in(model, team, false, model.grid.run(x, k)); };
    const SlotRun mine = run_of(lane), last = run_of(pair_lanes);
    for (int z = 0; z < GridView<Real>::runs; z += rows) {
        SlotRun run[rows]{};
        Vec4<Real> at[rows][at_once];
        const auto slot = [&](int k, int u) {
            const int other = run[k].begin + u * pair_lanes + lane;
            return other < run[k].end ? other : model.particles;
        };
#pragma unroll
        for (int k = 0; k < rows; ++k) {
            run[k] = z + k < pair_lanes ? of_lane<pair_lanes>(mine, z + k) : last;
#pragma unroll
            for (int u = 0; u < at_once; ++u) at[k][u] = team.predicted_position()[slot(k, u)];
        }
#pragma unroll
        for (int k = 0; k < rows; ++k) {
#pragma unroll
            for (int u = 0; u < at_once; ++u) look_at(slot(k, u), at[k][u]);
            for (int u = at_once; __any_sync(all_lanes, run[k].begin + u * pair_lanes < run[k].end); ++u)
                look_at(slot(k, u), team.predicted_position()[slot(k, u)]);
        }
    }
    if (s < 0) return;
    const auto beyond = static_cast<std::uint16_t>(model.particles);
    n = min(n, model.max_neighbours);
    for (int k = n + lane; k < max_listed_on_chip; k += pair_lanes) list[k] = beyond;
    if (n > max_listed_on_chip && lane < (8 - n % 8) % 8) list_entry(model, team, s, n + lane) = beyond;
    if (lane == 0) team.neighbour_count()[s] = team.chip_neighbour_count()[own] = static_cast<std::uint16_t>(n);
    __syncwarp(0xffu << first_lane);
    if (8 * lane < min(n, max_listed_on_chip))
        team.neighbour()[static_cast<std::size_t>(lane) * model.fluid + s] = reinterpret_cast<const uint4*>(list)[lane];
}

/// find_neighbours by a warp for each slot that may have contacts, and `pair_lanes` threads for each slot's fluid
/// neighbours. Ends with a barrier.
template <class Real, class Team>
__device__ void find_neighbours_by_lanes(const ModelView<Real>& model, Team& team) {
    const int others = team.blocks() - 1;
    const int searched = model.plan.contacts ? model.solids + team.shared().near : 0;
    if (!team.has_solids())
        for_each_warp_task(team, others, searched, others * team.slots_of_block() / slots_of_warp, [&](int task) {
            if (task >= searched) return list_fluid_neighbours_of_task(model, team, task - searched);
            const int k = task - model.solids;  // of the fluid that may have contacts
            find_contacts_by_warp(model, team, k < 0 ? model.fluid + task : team.searched()[k]);
        });
    team.barrier();
}

/// The list of contacts of slot s, whose entries lie `stride` apart.
template <class Real, class Team>
__device__ const std::uint16_t* contacts_of(const ModelView<Real>& model, const Team& team, int s,
                                            std::size_t& stride) {
    stride = s < model.fluid ? model.fluid : model.solids;
    return s < model.fluid ? team.fluid_contact() + s : team.solid_contact() + (s - model.fluid);
}

/// Puts the first of this block's `contact_slot_count` slots, and the first contacts of each, on its chip. Ends with a
/// barrier of the block.
template <class Real, class Team>
__device__ void load_contacts(const ModelView<Real>& model, const Team& team, int contact_slot_count) {
    const int lane = static_cast<int>(threadIdx.x) % 32;
    for (int own = static_cast<int>(threadIdx.x) / 32; own < max_contact_slots_on_chip; own += Team::warps) {
        const int task = own * (team.blocks() - 1) + team.block();
        if (task >= contact_slot_count) break;
        const int s = team.contact_slots()[task], count = team.contact_count()[s];
        std::size_t stride;
        const std::uint16_t* const list = contacts_of(model, team, s, stride);
        if (lane < min(count, max_listed_on_chip))
            team.chip_contact()[max_listed_on_chip * own + lane] = list[lane * stride];
        if (lane == 0) {
            team.chip_contact_slots()[own] = static_cast<std::uint16_t>(s);
            team.chip_contact_count()[own] = static_cast<std::uint16_t>(count);
        }
    }
    __syncthreads();
}

}  // namespace natator::cuda
