#pragma once

// Where a team has many blocks, the last of them computes springs and clusters by itself, with the solids on its chip,
// and the others have the fluid meanwhile: a fit, four steps in double one after the other, takes as long as the
// densities of the fluid, and nothing but solids waits for it. The formulas and the bits are those of flex.cuh.
#include "shared_slots.cuh"

namespace natator::cuda {

/// Calls work(k) for k = 0 .. count - 1 by the threads of this block.
template <class Team, class Work>
__device__ void for_each_in_block(const Team&, int count, const Work& work) {
#pragma unroll 1  // it seldom goes round twice
    for (int k = static_cast<int>(threadIdx.x); k < count; k += Team::threads) work(k);
}

/// What springs and clusters are, for an update whose rest lengths are known. Barriers follow before it is read.
template <class Real, class Team>
__device__ void load_constraints_of_solids(const ModelView<Real>& model, const Team& team) {
    if (!team.has_solids()) return;
    for_each_in_block(team, model.solids + 1, [&](int i) {
        team.chip_springs_begin()[i] = model.spring_incidences_begin[i];
        team.chip_members_begin()[i] = model.cluster_incidences_begin[i];
    });
    for_each_in_block(team, 2 * model.springs, [&](int e) {
        const Incidence incidence = model.spring_incidence[e];
        team.chip_spring()[e] = {incidence.other, team.rest_length()[incidence.constraint],
                                 model.spring[incidence.constraint].rule};
    });
    for_each_in_block(team, model.members, [&](int e) {
        team.chip_member_incidence()[e] = model.cluster_incidence[e];
        team.chip_member()[e] = quad(model.offset[e], as_number<Real>(model.member[e]));
    });
    for_each_in_block(team, model.clusters, [&](int k) { team.chip_cluster()[k] = model.cluster[k]; });
}

/// Where the solids are, and the fits as they are. Ends with a barrier of the block.
template <class Real, class Team>
__device__ void load_solids(const ModelView<Real>& model, const Team& team) {
    for_each_in_block(team, model.solids,
                      [&](int i) { team.chip_solid()[i] = team.position()[team.slot_of_solid()[i]]; });
    for_each_in_block(team, model.clusters, [&](int k) { team.chip_fit()[k] = team.fit()[k]; });
    __syncthreads();
}

/// Fits all clusters, each by a warp, beside those whose threads have a solid each.
template <class Real, class Team>
__device__ void fit_clusters_on_chip(const ModelView<Real>& model, const Team& team) {
    const int of_solids = (model.solids + 31) / 32, first = static_cast<int>(threadIdx.x) / 32 - of_solids;
    if (first < 0) return;
    for (int k = first; k < model.clusters; k += Team::warps - of_solids) {
        const int begin = team.chip_cluster()[k].begin, end = team.chip_cluster()[k].end;
        const Vec4<Real>* const member = team.chip_member() + begin;
        ClusterFit<Real>& fit = team.chip_fit()[k];
        fit_members(
            end - begin, fit, [&](int m) { return xyz(team.chip_solid()[number_in(member[m].w)]); },
            [&](int m) { return xyz(member[m]); });
        if (threadIdx.x % 32 == 0) team.fit()[k] = fit;
    }
}

/// Corrects all solids; waits for the others' pushes of contacts and for this block's fits on the way.
template <class Real, class Team>
__device__ void correct_solids_on_chip(const ModelView<Real>& model, const Team& team) {
    const int i = static_cast<int>(threadIdx.x);
    const bool there = i < model.solids;
    Correction<Real> correction;
    Vec4<Real> here{};
    int s = 0;
    SlotContacts touch{};
    if (there) {
        here = team.chip_solid()[i];
        s = team.slot_of_solid()[i];
        touch = slot_contacts(model, team, s);
        add_springs<1>(correction, xyz(here), here.w, team.chip_springs_begin()[i], team.chip_springs_begin()[i + 1],
                       [&](int e) {
                           const ChipSpring<Real>& spring = team.chip_spring()[e];
                           const Vec4<Real> other = team.chip_solid()[spring.other];
                           return SpringEnd<Real>{xyz(other), other.w, spring.rest_length, spring.rule};
                       });
    }
    team.wait_for_others();
    if (!there) return;
    add_clusters<1>(correction, xyz(here), team.chip_members_begin()[i], team.chip_members_begin()[i + 1], [&](int e) {
        const Incidence incidence = team.chip_member_incidence()[e];
        return ClusterMember<Real>{team.chip_fit()[incidence.constraint], xyz(team.chip_member()[incidence.other]),
                                   team.chip_cluster()[incidence.constraint].stiffness};
    });
    team.chip_solid()[i] = apply(model, team, s, xyz(here), here.w, correction, touch);
}

/// The first half of an iteration of a team that is split so: densities and pushes of contacts, of so many tasks; fits
/// have begun. Ends with a barrier of the blocks that have the fluid.
template <class Real, class Team>
__device__ void compute_density_beside_solids(const ModelView<Real>& model, Team& team, int contact_tasks) {
    if (team.has_solids()) return fit_clusters_on_chip(model, team);
    if constexpr (Team::shares_slots) return compute_density_by_lanes(model, team, contact_tasks);
    const int of_fluid = fluid_tasks(model);
    for_each_warp_task(team, team.blocks() - 1, contact_tasks, of_fluid, [&](int task) {
        if (task < contact_tasks) return solve_contacts(model, team, task);
        const int s = fluid_slot(task - contact_tasks, of_fluid);
        if (s < model.fluid) compute_density_of(model, team, s);
    });
    team.barrier_of_others();
}

/// The other half. A barrier follows, behind which the block of the solids does not wait for the others.
template <class Real, class Team>
__device__ void apply_corrections_beside_solids(const ModelView<Real>& model, Team& team) {
    if (team.has_solids()) return correct_solids_on_chip(model, team);
    if constexpr (Team::shares_slots) return correct_fluid_by_lanes(model, team);
    const int of_fluid = fluid_tasks(model);
    for_each_warp_task(team, team.blocks() - 1, 0, of_fluid, [&](int task) {
        const int s = fluid_slot(task, of_fluid);
        if (s < model.fluid) correct_fluid(model, team, s);
    });
}

}  // namespace natator::cuda
