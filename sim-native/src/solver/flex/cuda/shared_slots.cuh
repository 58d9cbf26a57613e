#pragma once

// Where a team has many blocks, `slot_lanes` threads share a slot of the fluid and a warp a slot that has contacts:
// what a thread reads one after another takes longer there than all else. Each reads a part of the slot's list, and
// what they find is added up in the order in which one thread would have. The formulas and the bits are those of
// flex.cuh.
#include "flex.cuh"
#include "shared_search.cuh"

namespace natator::cuda {

/// Adds find(slot) for the fluid neighbours of fluid slot s, one of this block's, to a Sum, in the order of its list;
/// of none if s is -1. All threads of a warp call it together, `slot_lanes` for each slot, of which each has a chunk of
/// the list; all of these get the sum.
template <class Sum, class Real, class Team, class Find>
__device__ Sum sum_over_neighbours(const ModelView<Real>& model, const Team& team, int s, const Find& find) {
    constexpr int in_chunk = 8;
    const int lane = static_cast<int>(threadIdx.x) % slot_lanes, own = s - team.first_slot();
    const int chunks = s < 0 ? 0 : (team.chip_neighbour_count()[own] + in_chunk - 1) / in_chunk;
    int most = chunks;  // of any slot of the warp
    for (int step = slot_lanes; step < 32; step *= 2) most = max(most, __shfl_xor_sync(0xffffffff, most, step));
    const unsigned beyond = static_cast<unsigned>(model.particles) * 0x10001u;
    Sum sum{};
    for (int first = 0; first < most; first += slot_lanes) {
        const int chunk = first + lane;
        uint4 others{beyond, beyond, beyond, beyond};
        if (chunk < chunks)
            others = first == 0 ? reinterpret_cast<const uint4*>(team.chip_neighbour())[own * slot_lanes + lane]
                                : team.neighbour()[static_cast<std::size_t>(chunk) * model.fluid + s];
        const unsigned words[in_chunk / 2] = {others.x, others.y, others.z, others.w};
        decltype(find(0)) found[in_chunk];
#pragma unroll
        for (int k = 0; k < in_chunk; ++k) found[k] = find(static_cast<int>(words[k / 2] >> k % 2 * 16 & 0xffff));
        for (int k = 0; k < min(slot_lanes, most - first); ++k) {
            Sum more = sum;
#pragma unroll
            for (const auto& one : found) one.add_to(more);
            sum = of_lane<slot_lanes>(more, k);
        }
    }
    return sum;
}

/// Writes what its contacts push the slot of a task by, by a warp. Four lanes have what one lane of solve_contacts has.
template <class Real, class Team>
__device__ void solve_contacts_by_warp(const ModelView<Real>& model, const Team& team, int task) {
    constexpr int rounds = 32 / pair_lanes;
    const int lane = static_cast<int>(threadIdx.x) % 32, own = task / (team.blocks() - 1);
    const bool on_chip = own < max_contact_slots_on_chip;
    const int s = on_chip ? team.chip_contact_slots()[own] : team.contact_slots()[task];
    const int count = on_chip ? team.chip_contact_count()[own] : team.contact_count()[s];
    const Vec4<Real> here = team.position()[s];
    const Vec3<Real> start = xyz(team.start()[s]);
    std::size_t stride;
    const std::uint16_t* const list = contacts_of(model, team, s, stride);
    Correction<Real> push;
    for (int first = 0; first < count; first += 32) {
        Vec4<Real> found{};
        bool touches = false;
        if (first + lane < count) {
            const int other = on_chip && first == 0 ? team.chip_contact()[max_listed_on_chip * own + lane]
                                                    : list[(first + lane) * stride];
            const Vec4<Real> there = team.position()[other];
            const Vec3<Real> start_there = xyz(team.start()[other]);
            push_by_contact(
                model, team, s, here, other, there, [&](int slot) { return slot == s ? start : start_there; },
                [&](const Vec4<Real>& by) {
                    found = by;
                    touches = true;
                });
        }
        for (int round = 0; round < rounds; ++round) {
            const auto of_round = [&](auto value) {
                return __shfl_sync(0xffffffff, value, round * pair_lanes + lane % pair_lanes);
            };
            const Vec4<Real> by{of_round(found.x), of_round(found.y), of_round(found.z), of_round(found.w)};
            if (of_round(static_cast<int>(touches))) push.add(by);
        }
    }
    const Vec4<Real> all{sum_of_lanes(push.sum.x), sum_of_lanes(push.sum.y), sum_of_lanes(push.sum.z),
                         sum_of_lanes(push.constraints)};
    if (lane == 0) team.contact_push()[s] = all;
}

/// Writes rho_i - 1, but at least 0, beside the positions of a task of the fluid.
template <class Real, class Team>
__device__ void compute_density_of_task(const ModelView<Real>& model, const Team& team, int task) {
    const int s = shared_fluid_slot<slot_lanes>(model, task);
    const Vec3<Real> x = xyz(team.position()[s < 0 ? model.particles : s]);
    const auto fluid = sum_over_neighbours<physics::FlexDensity<Real>>(
        model, team, s, [&](int other) { return density_part(model, x, xyz(team.position()[other])); });
    if (s >= 0 && threadIdx.x % slot_lanes == 0)
        set_compression(model, team, s, x, compression_with(model, team, s, x, fluid));
}

/// Densities of the fluid and pushes of `contact_tasks` slots that have contacts. Ends with a barrier of the blocks
/// that have the fluid.
template <class Real, class Team>
__device__ void compute_density_by_lanes(const ModelView<Real>& model, Team& team, int contact_tasks) {
    for_each_warp_task(team, team.blocks() - 1, contact_tasks, shared_fluid_tasks<slot_lanes>(model), [&](int task) {
        if (task < contact_tasks) return solve_contacts_by_warp(model, team, task);
        compute_density_of_task(model, team, task - contact_tasks);
    });
    team.barrier_of_others();
}

/// Corrects the fluid.
template <class Real, class Team>
__device__ void correct_fluid_by_lanes(const ModelView<Real>& model, Team& team) {
    for_each_warp_task(team, team.blocks() - 1, 0, shared_fluid_tasks<slot_lanes>(model), [&](int task) {
        const int s = shared_fluid_slot<slot_lanes>(model, task);
        const Vec4<Real> here = team.scratch_position()[s < 0 ? model.particles : s];
        const auto push = sum_over_neighbours<physics::FlexPush<Real>>(
            model, team, s, [&](int other) { return push_part(model, here, team.scratch_position()[other]); });
        if (s >= 0 && threadIdx.x % slot_lanes == 0)
            correct_fluid(model, team, s, [&](const Vec4<Real>&) { return push; });
    });
}

/// True if all that this thread wrote is finite.
template <class Real, class Team>
__device__ bool update_velocities_by_lanes(const ModelView<Real>& model, Team& team) {
    const int of_solids = (model.solids + 31) / 32;
    bool finite = true;
    if (team.has_solids()) return finite;
    for_each_warp_task(team, team.blocks() - 1, of_solids, shared_fluid_tasks<slot_lanes>(model), [&](int task) {
        if (task < of_solids) {
            const int s = model.fluid + task * 32 + static_cast<int>(threadIdx.x) % 32;
            if (s < model.particles)
                finite &=
                    set_new_velocity(team, s, velocity_with(model, team, s, displacement_rate<Real>(team, s), {}));
            return;
        }
        const int s = shared_fluid_slot<slot_lanes>(model, task - of_solids), there = s < 0 ? model.particles : s;
        const Vec3<Real> x = xyz(team.position()[there]), u = displacement_rate<Real>(team, there);
        physics::FlexSmoothing<Real> smoothing;
        if (model.plan.viscosity)
            smoothing = sum_over_neighbours<physics::FlexSmoothing<Real>>(model, team, s, [&](int other) {
                return smoothing_part(model, x, u, xyz(team.position()[other]), displacement_rate<Real>(team, other));
            });
        if (s >= 0 && threadIdx.x % slot_lanes == 0)
            finite &= set_new_velocity(team, s, velocity_with(model, team, s, u, smoothing));
    });
    return finite;
}

}  // namespace natator::cuda
