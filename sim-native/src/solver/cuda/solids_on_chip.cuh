#pragma once

// Where a team has many blocks, the last of them computes springs and clusters by itself, with the solids on its chip, and the
// others have the fluid meanwhile: a fit, four steps in double one after the other, takes as long as the densities of the fluid,
// and nothing but solids waits for it. The formulas and the bits are those of flex.cuh.
#include "flex.cuh"

namespace natator::cuda {

/// What the warps of that block do: a thread for each solid, a warp for one cluster or several in turn.
struct SolidWarps {
    int solids, clusters;

    template <class Real>
    __device__ explicit SolidWarps(const ModelView<Real>& model)
        : solids((model.solids + 31) / 32), clusters(min(model.clusters, warps - solids)) {}
};

/// What springs and clusters are, for an update whose rest lengths are known. Barriers follow before it is read.
template <class Real, class Team>
__device__ void load_constraints_of_solids(const ModelView<Real>& model, const Team& team) {
    if (!team.has_solids()) return;
    const auto each = [](int count, const auto& load) {
        for (int e = static_cast<int>(threadIdx.x); e < count; e += threads) load(e);
    };
    each(model.solids + 1, [&](int i) {
        team.chip_springs_begin()[i] = model.spring_shares_begin[i];
        team.chip_members_begin()[i] = model.cluster_shares_begin[i];
    });
    each(2 * model.springs, [&](int e) {
        const Share share = model.spring_share[e];
        team.chip_spring()[e] = {share.other, team.rest_length()[share.constraint], model.spring[share.constraint].rule};
    });
    each(model.members, [&](int e) {
        team.chip_member_share()[e] = model.cluster_share[e];
        team.chip_member()[e] = quad(model.offset[e], as_number<Real>(model.member[e]));
    });
    each(model.clusters, [&](int k) { team.chip_cluster()[k] = model.cluster[k]; });
}

/// Where the solids are, and the fits as they are. Ends with a barrier of the block.
template <class Real, class Team>
__device__ void load_solids(const ModelView<Real>& model, const Team& team) {
    for (int i = static_cast<int>(threadIdx.x); i < model.solids; i += threads)
        team.chip_solid()[i] = team.position()[team.slot_of_solid()[i]];
    for (int k = static_cast<int>(threadIdx.x); k < model.clusters; k += threads) team.chip_fit()[k] = team.fit()[k];
    __syncthreads();
}

/// Fits all clusters, by the warps that have them.
template <class Real, class Team>
__device__ void fit_clusters_on_chip(const ModelView<Real>& model, const Team& team) {
    const SolidWarps work(model);
    const int warp = static_cast<int>(threadIdx.x) / 32, first = warp - work.solids;
    if (first < 0 || first >= work.clusters) return;
    for (int k = first; k < model.clusters; k += work.clusters) {
        const int begin = team.chip_cluster()[k].begin, end = team.chip_cluster()[k].end;
        const Quad<Real>* const member = team.chip_member() + begin;
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
    Quad<Real> here{};
    int s = 0;
    Touch touch{};
    if (there) {
        here = team.chip_solid()[i];
        s = team.slot_of_solid()[i];
        touch = touch_of(model, team, s);
        add_springs<1>(correction, xyz(here), here.w, team.chip_springs_begin()[i], team.chip_springs_begin()[i + 1],
                       [&](int e) {
                           const ChipSpring<Real>& spring = team.chip_spring()[e];
                           const Quad<Real> other = team.chip_solid()[spring.other];
                           return SpringEnd<Real>{xyz(other), other.w, spring.rest_length, spring.rule};
                       });
    }
    team.wait();
    if (!there) return;
    add_clusters<1>(correction, xyz(here), team.chip_members_begin()[i], team.chip_members_begin()[i + 1],
                    [&](int e, const auto& push) {
                        const Share share = team.chip_member_share()[e];
                        return push(team.chip_fit()[share.constraint], xyz(team.chip_member()[share.other]),
                                    team.chip_cluster()[share.constraint].stiffness);
                    });
    team.chip_solid()[i] = apply(model, team, s, xyz(here), here.w, correction, touch);
}

/// The first half of an iteration of a team that is split so: densities and pushes of contacts, of so many units; fits have
/// begun. Ends with a barrier of the blocks that have the fluid.
template <class Real, class Team>
__device__ void compute_density_beside_solids(const ModelView<Real>& model, Team& team, int touched) {
    if (team.has_solids()) {
        team.arrive();
        return fit_clusters_on_chip(model, team);
    }
    const int of_fluid = fluid_units(model);
    for_each_unit(team, team.blocks() - 1, touched, of_fluid, [&](int unit) {
        if (unit < touched) return push_touched(model, team, unit);
        const int s = fluid_slot(unit - touched, of_fluid);
        if (s < model.fluid) compute_density_of(model, team, s, Real(0));
    });
    team.barrier();
}

/// The other half. A barrier follows.
template <class Real, class Team>
__device__ void apply_corrections_beside_solids(const ModelView<Real>& model, Team& team) {
    if (team.has_solids()) return correct_solids_on_chip(model, team);
    const int of_fluid = fluid_units(model);
    for_each_unit(team, team.blocks() - 1, 0, of_fluid, [&](int unit) {
        const int s = fluid_slot(unit, of_fluid);
        if (s < model.fluid) correct_fluid(model, team, s);
    });
}

}  // namespace natator::cuda
