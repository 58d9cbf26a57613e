#pragma once

#include "contacts.cuh"

namespace natator::cuda {

/// Without pairs to search slots keep their numbers.
template <class Real>
__device__ bool needs_cells(const ModelView<Real>& model) {
    return model.plan.fluid || model.plan.contacts;
}

template <class Real>
__device__ Vec3<Real> predicted_velocity(const ModelView<Real>& model, const Vec3<Real>& v, Real inverse_mass,
                                         bool fluid, Real h) {
    return physics::predicted_velocity(v, inverse_mass, fluid ? model.fluid_gravity : model.gravity, h,
                                       model.plan.clamp_speed, model.max_speed);
}

/// Nothing is in any cell. Barriers follow before they are counted.
template <class Real, class Team>
__device__ void clear_cells(const ModelView<Real>& model, const Team& team) {
    for (int c = team.thread(); c < model.grid.words(); c += team.size()) team.table()[c] = 0;
}

/// The cell of slot s in the table: the fluid's come first.
template <class Real>
__device__ int cell_of(const ModelView<Real>& model, const Vec4<Real>& x, int s) {
    return model.grid.cell(xyz(x)) + (s < model.fluid ? 0 : model.grid.cells);
}
/// The slots of some cells of the table, once it has the cells' ends.
template <class Team>
__device__ SlotRun slots_between(const Team& team, int first, int last) {
    const std::uint32_t* const table = team.cell_ends();
    return {first > 0 ? half_of(table, first - 1) : 0, half_of(table, last)};
}

/// v*, x* = x + h v*; counts the particles of each cell, the fluid's first. Ends with a barrier.
template <class Real, class Team>
__device__ void predict(const ModelView<Real>& model, Team& team) {
    std::uint32_t* const table = team.table();
    for (int k = team.thread(); k < model.clusters; k += team.size()) team.fit_before()[k] = team.fit()[k];
    for (int s = team.thread(); s < model.particles; s += team.size()) {
        const Vec4<Real> x = team.position()[s];
        const Real inverse_mass = x.w;
        const Vec3<Real> v = predicted_velocity(model, xyz(team.velocity[s]), inverse_mass, s < model.fluid, team.h);
        const Vec3<Real> there = xyz(x) + team.h * v;
        const Vec4<Real> unsorted = quad(there, as_number<Real>(team.number()[s]));
        team.unsorted_position()[s] = unsorted;
        team.unsorted_velocity()[s] = quad(v, inverse_mass);
        team.unsorted_start()[s] = x;
        if (!needs_cells(model)) continue;
        const int rank = count_up(table, cell_of(model, unsorted, s));
        if constexpr (Team::shares_slots) team.rank()[s] = static_cast<typename Team::Index>(rank);
    }
    team.barrier();
}

/// Box around the solids, whose predicted positions are given by slot, by one warp.
template <class Real, class Team>
__device__ void bound_solids(const ModelView<Real>& model, const Team& team, const Vec4<Real>* predicted) {
    const int lane = static_cast<int>(threadIdx.x) % 32;
    Real low[3] = {Real(1e30), Real(1e30), Real(1e30)}, high[3] = {Real(-1e30), Real(-1e30), Real(-1e30)};
    for (int s = model.fluid + lane; s < model.particles; s += 32) {
        const Vec4<Real> x = predicted[s];
        const Real at[3] = {x.x, x.y, x.z};
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = min(low[axis], at[axis]);
            high[axis] = max(high[axis], at[axis]);
        }
    }
    for (int axis = 0; axis < 3; ++axis) {
        for (int step = 16; step > 0; step /= 2) {
            low[axis] = min(low[axis], __shfl_xor_sync(0xffffffff, low[axis], step));
            high[axis] = max(high[axis], __shfl_xor_sync(0xffffffff, high[axis], step));
        }
        if (lane == 0) {
            team.shared().solids_low[axis] = low[axis] - model.search_distance;
            team.shared().solids_high[axis] = high[axis] + model.search_distance;
        }
    }
}

/// Sums of all cells' counts up to each, by every block for itself. Ends with a barrier of the block.
template <class Real, class Team>
__device__ void scan_cells_on_chip(const ModelView<Real>& model, const Team& team) {
    const auto* const counts = reinterpret_cast<const uint4*>(team.table());  // eight of them
    auto* const ends = reinterpret_cast<uint4*>(team.chip_table());
    const int chunks = model.grid.words() / 4, share = (chunks + Team::threads - 1) / Team::threads;
    const int begin = min(static_cast<int>(threadIdx.x) * share, chunks), end = min(begin + share, chunks);
    std::uint32_t sum = 0;
    for (int i = begin; i < end; ++i) {
        const uint4 own = counts[i];
        const std::uint32_t both = (own.x + own.y) + (own.z + own.w);  // no half of it overflows
        sum += (both & 0xffff) + (both >> 16);
    }
    int all;
    sum = static_cast<std::uint32_t>(sum_before<Team::warps>(static_cast<int>(sum), team.of_block().sums, all));
    const auto up_to = [&](std::uint32_t word) {
        const std::uint32_t first = sum + (word & 0xffff);
        sum = first + (word >> 16);
        return first | sum << 16;
    };
    for (int i = begin; i < end; ++i) {
        const uint4 own = counts[i];
        uint4 to;
        to.x = up_to(own.x);
        to.y = up_to(own.y);
        to.z = up_to(own.z);
        to.w = up_to(own.w);
        ends[i] = to;
    }
    __syncthreads();
}

/// The keys of the particles, number and slot before: by cell, in no order within one. Leaves the cells' ends in the
/// table. Ends with a barrier.
template <class Real, class Team>
__device__ void scatter_keys(const ModelView<Real>& model, Team& team) {
    std::uint32_t* const table = team.table();
    std::uint32_t* const keys = team.keys();
    const auto key_of = [](int number, int s) { return static_cast<std::uint32_t>(number) << 16 | s; };
    if (needs_cells(model)) {
        if constexpr (Team::shares_slots)
            scan_cells_on_chip(model, team);
        else
            exclusive_scan(team, table, 2 * model.grid.cells);
    }
    for (int s = team.thread(); s < model.particles; s += team.size()) {
        const Vec4<Real> there = team.unsorted_position()[s];
        int place = s;
        if (needs_cells(model)) {
            const int cell = cell_of(model, there, s);
            if constexpr (Team::shares_slots)
                place = slots_between(team, cell, cell).begin + team.rank()[s];
            else
                place = count_up(table, cell);
        }
        keys[place] = key_of(number_in(there.w), s);
    }
    team.barrier();
}

/// The slot of the particle whose key is at place k: by how many of its cell come before it, which is the same whatever
/// order the atomics came in.
template <class Real, class Team>
__device__ int slot_of_key(const ModelView<Real>& model, const Team& team, int k) {
    if (!needs_cells(model)) return k;
    const std::uint32_t* const keys = team.keys();
    const std::uint32_t key = keys[k];
    const int before = key & 0xffff;
    const int cell = cell_of(model, team.unsorted_position()[before], before);
    const SlotRun run = slots_between(team, cell, cell);
    int slot = run.begin;
    for (int other = run.begin; other < run.end; ++other) slot += keys[other] < key;
    return slot;
}

/// Is it in the box around the solids?
template <class Team, class Real>
__device__ bool near_solids(const Team& team, const Vec3<Real>& x) {
    const auto& shared = team.shared();
    const Real at[3] = {x.x, x.y, x.z};
    for (int axis = 0; axis < 3; ++axis)
        if (at[axis] < shared.solids_low[axis] || at[axis] > shared.solids_high[axis]) return false;
    return true;
}

/// May what is here touch plane k in this substep?
template <class Real>
__device__ bool is_near_plane(const ModelView<Real>& model, int k, const Vec4<Real>& here) {
    return here.w > 0 && distance_to(model.plane[k].surface, xyz(here)) <= model.plane_search_distance;
}
/// Planes that slot s may touch in this substep.
template <class Real, class Team>
__device__ void note_near_planes(const ModelView<Real>& model, const Team& team, int s, const Vec4<Real>& here) {
    unsigned planes = 0;
    for (int k = 0; k < model.planes; ++k) planes |= static_cast<unsigned>(is_near_plane(model, k, here)) << k;
    team.plane_contact()[s] = static_cast<typename Team::Index>(planes);
}

/// Planes of slot s, and whether the search looks for its contacts, where a team has a warp for those of each slot.
template <class Real, class Team>
__device__ void note_surroundings(const ModelView<Real>& model, const Team& team, int s, const Vec4<Real>& here) {
    note_near_planes(model, team, s, here);
    if (!model.plan.contacts || s >= model.fluid) return;
    if (near_solids(team, xyz(here)))
        team.searched()[atomicAdd(&team.shared().near, 1)] = static_cast<typename Team::Index>(s);
    else
        team.contact_count()[s] = 0;
}

/// Numbers the slots anew, in the order of their cells and within each by particle, and puts everything in its new
/// place. Ends with a barrier.
template <class Real, class Team>
__device__ void sort_into_cells(const ModelView<Real>& model, Team& team) {
    if (team.thread() == 0) team.shared().contact_slot_count = team.shared().near = 0;
    if (model.plan.contacts && team.thread() >= team.size() - 32)  // which has least to do
        bound_solids(model, team, team.unsorted_position());
    scatter_keys(model, team);
    for (int k = team.thread(); k < model.particles; k += team.size()) {
        const std::uint32_t key = team.keys()[k];
        const int before = key & 0xffff, number = static_cast<int>(key >> 16), s = slot_of_key(model, team, k);
        const Vec4<Real> v = team.unsorted_velocity()[before];
        team.start()[s] = team.unsorted_start()[before];
        team.predicted_velocity()[s] = v;
        const Vec4<Real> here = team.position()[s] = quad(xyz(team.unsorted_position()[before]), v.w);
        if constexpr (Team::shares_slots) note_surroundings(model, team, s, here);
        team.number()[s] = static_cast<std::uint16_t>(number);
        if (s >= model.fluid) team.slot_of_solid()[number - model.fluid] = static_cast<std::uint16_t>(s);
    }
    team.barrier();
}

/// Does particle i feel particle j? The same as Substep::collides.
template <class Real>
__device__ bool collides(const ModelView<Real>& model, int i, int j) {
    if ((model.phase[i] & phase::group_mask) != (model.phase[j] & phase::group_mask)) return true;
    if (!(model.phase[i] & phase::self_collide)) return false;
    if (!(model.phase[i] & phase::self_collide_filter) || !model.rest_position) return true;
    return norm(model.rest_position[i] - model.rest_position[j]) >= model.radius;
}

/// The slots in a run of cells, of the fluid or the solids.
template <class Real, class R, TeamKind kind>
__device__ SlotRun slots_in(const ModelView<Real>& model, const StateTeam<R, kind>& team, bool solids,
                            const CellRun& run) {
    if (run.last < run.first) return {0, 0};
    const int offset = solids ? model.grid.cells : 0;
    return slots_between(team, run.first + offset, run.last + offset);
}

/// Is a predicted position nearer to x than the search distance, but not there?
template <class Real>
__device__ bool is_near(const ModelView<Real>& model, const Vec3<Real>& x, const Vec4<Real>& predicted) {
    const Vec3<Real> difference = x - xyz(predicted);
    const Real r2 = dot(difference, difference);
    return r2 < model.search_distance * model.search_distance && r2 > 0;
}

/// Calls visit(slot, is it near?) for the slots in the cells around x, of the fluid or the solids.
template <class Real, class Team, class Visit>
__device__ void for_each_candidate(const ModelView<Real>& model, const Team& team, bool solids, const Vec3<Real>& x,
                                   const Visit& visit) {
    model.grid.for_each_run(x, [&](const CellRun& cells) {
        const SlotRun run = slots_in(model, team, solids, cells);
        for (int other = run.begin; other < run.end; ++other)
            visit(other, is_near(model, x, team.predicted_position()[other]));
    });
}

/// Are particle i and what is in slot `other` in contact where they are near?
template <class Real, class Team>
__device__ bool may_touch(const ModelView<Real>& model, const Team& team, int i, int other) {
    const int j = team.number()[other];
    return collides(model, i, j) || (model.plan.mutual_contacts && collides(model, j, i));
}

/// Does slot s touch fluid, too?
template <class Real>
__device__ bool touches_fluid(const ModelView<Real>& model, int s) {
    return s >= model.fluid && !model.plan.water;
}

/// Calls visit(k, slot) for what slot s is in contact with, in the order of its list; returns how many there are.
template <class Real, class Team, class Visit>
__device__ int search_contacts(const ModelView<Real>& model, const Team& team, int s, const Visit& visit) {
    const Vec3<Real> x = xyz(team.predicted_position()[s]);
    const int i = team.number()[s];
    int n = 0;
    const auto search = [&](bool solids) {
        for_each_candidate(model, team, solids, x, [&](int other, bool near) {
            if (!near || !may_touch(model, team, i, other)) return;
            visit(n, other);
            ++n;
        });
    };
    if (touches_fluid(model, s)) search(false);
    search(true);
    return n;
}

/// Calls visit(k, slot) for the slots near x that are wanted(slot), of the fluid first, then of the solids, in the
/// order of their cells; returns how many there are. By a warp, each of them visited by one lane.
template <class Real, class Team, class Wanted, class Visit>
__device__ int search_by_warp(const ModelView<Real>& model, const Team& team, const Vec3<Real>& x, bool in_fluid,
                              bool in_solids, const Wanted& wanted, const Visit& visit) {
    constexpr unsigned all_lanes = 0xffffffff;
    constexpr int runs = GridView<Real>::runs;
    const int lane = threadIdx.x % 32;
    // A run for each lane, the fluid's first, and where its slots end among those of all runs.
    const bool solids = lane >= runs;
    SlotRun run{0, 0};
    if (lane < 2 * runs && (solids ? in_solids : in_fluid))
        run = slots_in(model, team, solids, model.grid.run(x, lane % runs));
    int end = run.end - run.begin;
    for (int step = 1; step < 2 * runs; step *= 2) {
        const int before = __shfl_up_sync(all_lanes, end, step);
        if (lane >= step) end += before;
    }
    const int count = __shfl_sync(all_lanes, end, 2 * runs - 1);
    constexpr int at_once =
        Team::shares_slots ? 3 : 1;  // fetched before the first is looked at, where latency is what counts
    int n = 0;
    for (int first = 0; first < count; first += 32 * at_once) {
        int other[at_once];
        bool near[at_once];
#pragma unroll
        for (int u = 0; u < at_once; ++u) {
            const int k = first + 32 * u + lane;
            int before = 0;  // runs that end before candidate k; every lane takes part in all shuffles
            for (int step = 16; step > 0; step /= 2)
                if (__shfl_sync(all_lanes, end, before + step - 1) <= k) before += step;
            other[u] = __shfl_sync(all_lanes, run.end - end, before) + k;
            near[u] = k < count && is_near(model, x, team.predicted_position()[k < count ? other[u] : 0]);
        }
#pragma unroll
        for (int u = 0; u < at_once; ++u) {
            const bool found = near[u] && wanted(other[u]);
            const unsigned all_found = __ballot_sync(all_lanes, found);
            if (found) visit(n + __popc(all_found & ((1u << lane) - 1)), other[u]);
            n += __popc(all_found);
        }
    }
    return n;
}

/// search_contacts by a warp. What a thread finds one after another takes a solid, which is near many, longer than all
/// else takes.
template <class Real, class Team, class Visit>
__device__ int search_contacts_by_warp(const ModelView<Real>& model, const Team& team, int s, const Visit& visit) {
    const int i = team.number()[s];
    return search_by_warp(
        model, team, xyz(team.predicted_position()[s]), touches_fluid(model, s), true,
        [&](int other) { return may_touch(model, team, i, other); }, visit);
}

/// What lists the contacts of a slot.
template <class Real, class R, TeamKind kind>
__device__ auto contact_lister(const ModelView<Real>& model, const StateTeam<R, kind>& team, int s) {
    const bool fluid = s < model.fluid;
    std::uint16_t* const list = fluid ? team.fluid_contact() + s : team.solid_contact() + (s - model.fluid);
    const std::size_t stride = fluid ? model.fluid : model.solids;
    return [=](int k, int other) { list[k * stride] = static_cast<std::uint16_t>(other); };
}

/// Adds slot s to the slots that have contacts, and returns its place among them.
template <class Team>
__device__ int add_contact_slot(const Team& team, int s) {
    const int place = atomicAdd(&team.shared().contact_slot_count, 1);
    team.contact_slots()[place] = static_cast<typename Team::Index>(s);
    return place;
}
template <class Team>
__device__ void note_contacts(const Team& team, int s, int contacts) {
    team.contact_count()[s] = static_cast<typename Team::Index>(contacts);
    if (contacts > 0) add_contact_slot(team, s);
}

/// Lists the contacts of a slot that may have some, by a warp.
template <class Real, class Team>
__device__ void find_contacts_by_warp(const ModelView<Real>& model, const Team& team, int s) {
    const int contacts = search_contacts_by_warp(model, team, s, contact_lister(model, team, s));
    if (threadIdx.x % 32 == 0) note_contacts(team, s, contacts);
}
/// Lists contacts and planes of a solid, by a warp.
template <class Real, class Team>
__device__ void find_neighbours_of_solid(const ModelView<Real>& model, const Team& team, int s) {
    if (model.plan.contacts) find_contacts_by_warp(model, team, s);
    if (threadIdx.x % 32 == 0) note_near_planes(model, team, s, team.predicted_position()[s]);
}

/// Entry k of the list of fluid neighbours of slot s.
template <class Real, class Team>
__device__ std::uint16_t& list_entry(const ModelView<Real>& model, const Team& team, int s, int k) {
    uint4* const chunk = team.neighbour() + static_cast<std::size_t>(k / 8) * model.fluid + s;
    return reinterpret_cast<std::uint16_t*>(chunk)[k % 8];
}

/// Lists the fluid neighbours of a fluid slot. Entries are written on the chip first, one behind the other, without a
/// branch on what is near: what is not is written over by the next. A list that is too long for that is made anew in
/// its place. What ends the last chunk is the far slot.
template <class Real, class Team>
__device__ void list_fluid_neighbours(const ModelView<Real>& model, Team& team, int s, const Vec3<Real>& x) {
    std::uint16_t* const staging = team.staging() + threadIdx.x;
    const int staged = min(team.staged(), model.max_neighbours / 8 * 8);
    const int i = model.plan.uniform_fluid ? 0 : team.number()[s];
    const auto felt = [&](int other) {
        return model.plan.uniform_fluid || collides(model, i, static_cast<int>(team.number()[other]));
    };
    int n = 0;
    if (model.plan.uniform_fluid)
        for_each_candidate(model, team, false, x, [&](int other, bool near) {
            staging[min(n, staged) * Team::threads] = static_cast<std::uint16_t>(other);
            n += near;
        });
    else
        for_each_candidate(model, team, false, x, [&](int other, bool near) {
            staging[min(n, staged) * Team::threads] = static_cast<std::uint16_t>(other);
            n += near && felt(other);
        });
    const std::uint16_t beyond = static_cast<std::uint16_t>(model.particles);
    if (n > staged) {
        n = 0;
        for_each_candidate(model, team, false, x, [&](int other, bool near) {
            if (!near || n >= model.max_neighbours || !felt(other)) return;
            list_entry(model, team, s, n) = static_cast<std::uint16_t>(other);
            ++n;
        });
        for (int k = n; k % 8 != 0; ++k) list_entry(model, team, s, k) = beyond;
    } else {
        for (int k = n; k % 8 != 0; ++k) staging[k * Team::threads] = beyond;
        for (int k = 0; k < n; k += 8) {
            const auto two = [&](int e) {
                return staging[(k + e) * Team::threads] | static_cast<unsigned>(staging[(k + e + 1) * Team::threads])
                                                              << 16;
            };
            team.neighbour()[static_cast<std::size_t>(k / 8) * model.fluid + s] = {two(0), two(2), two(4), two(6)};
        }
    }
    team.neighbour_count()[s] = static_cast<std::uint16_t>(n);
}

/// Lists contacts and planes of the solids of a task: by a warp for one, or a thread for each of 32.
template <class Real, class Team>
__device__ void find_neighbours_of_solids(const ModelView<Real>& model, const Team& team, int task) {
    if (team.shares_solids()) return find_neighbours_of_solid(model, team, model.fluid + task);
    const int s = model.fluid + task * 32 + threadIdx.x % 32;
    if (s >= model.particles) return;
    if (model.plan.contacts) note_contacts(team, s, search_contacts(model, team, s, contact_lister(model, team, s)));
    note_near_planes(model, team, s, team.predicted_position()[s]);
}

/// Lists contacts and planes of a fluid slot.
template <class Real, class Team>
__device__ void find_contacts_of_fluid(const ModelView<Real>& model, const Team& team, int s) {
    const Vec4<Real> here = team.predicted_position()[s];
    if (model.plan.contacts) {
        const bool searched = near_solids(team, xyz(here));
        note_contacts(team, s, searched ? search_contacts(model, team, s, contact_lister(model, team, s)) : 0);
    }
    note_near_planes(model, team, s, here);
}

/// Lists fluid neighbours, contacts and planes of every slot at the predicted positions: first of the solids, which
/// take longest, then the contacts of the fluid near them. Ends with a barrier.
template <class Real, class Team>
__device__ void find_neighbours(const ModelView<Real>& model, Team& team) {
    const int of_solids = team.shares_solids() ? model.solids : (model.solids + 31) / 32;
    const int of_fluid = fluid_tasks(model);
    for_each_warp_task(team, of_solids + of_fluid, of_fluid, [&](int task) {
        if (task < of_solids) return find_neighbours_of_solids(model, team, task);
        const bool contacts = task < of_solids + of_fluid;
        const int s = fluid_slot(task - of_solids - (contacts ? 0 : of_fluid), of_fluid);
        if (s >= model.fluid) return;
        if (contacts) return find_contacts_of_fluid(model, team, s);
        list_fluid_neighbours(model, team, s, xyz(team.predicted_position()[s]));
    });
    team.barrier();
    if constexpr (Team::of_several_blocks) return;
    // `scratch_position` was room for the search; its far slot is what lists end with.
    if (team.thread() == 0) team.scratch_position()[model.particles] = far_away<Real>();
    team.barrier();
}

}  // namespace natator::cuda
