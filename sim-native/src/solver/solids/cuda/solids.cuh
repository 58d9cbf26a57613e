#pragma once

// Springs, clusters and planes of scheme conserving, by one block of threads: in device memory or on its chip, as
// `Solids` has them (solid_arrays.cuh). What is done to a solid is done by one thread, always the same.
#include "physics/spring.h"
#include "solid_arrays.cuh"
#include "solver/cuda/contacts.cuh"
#include "sums_of_warp.cuh"

namespace natator::cuda {

/// Moves what is at a place: the displacement is kept apart from where it started, so that it is not rounded to that.
template <class Real, class Solids>
__device__ void move(const Solids& solids, int place, const Vec3<Real>& by) {
    const Vec3<Real> displacement = xyz(solids.displacement()[place]) + by;
    solids.displacement()[place] = quad(displacement, Real(0));
    const Vec4<Real> predicted = solids.predicted_position()[place];
    solids.position()[place] = quad(xyz(predicted) + displacement, predicted.w);
}

/// Moves a solid by what its springs or clusters ask for, and books it as internal to its body.
template <class Real, class Solids>
__device__ void move_by_internal(const ModelView<Real>& model, const Solids& solids, int solid,
                                 const Vec3<Real>& correction) {
    const Vec3<Real> by = model.relaxation_factor * correction;
    solids.internal()[solid] = quad(xyz(solids.internal()[solid]) + by, Real(0));
    move(solids, solids.place(solid), by);
}

/// Position of a solid, with its inverse mass.
template <class Solids>
__device__ auto position_of(const Solids& solids, int solid) {
    return solids.position()[solids.place(solid)];
}

/// What stays the same in all iterations of a substep of length h, s: what springs go by, and the compliances of
/// clusters relative to their masses, not finite for those that ask for nothing. Ends with a barrier.
template <class Real, class Solids>
__device__ void prepare_constraints(const ModelView<Real>& model, const Solids& solids, Real h) {
    const auto count = [&](int solid) {
        return static_cast<Real>(solids.spring_incidences_begin()[solid + 1] - solids.spring_incidences_begin()[solid]);
    };
    for_each_in_block(model.springs, [&](int k) {
        const SpringView<Real> spring = solids.spring()[k];
        const Real wa = position_of(solids, spring.a).w, wb = position_of(solids, spring.b).w;
        const Real split = wa * count(spring.a) + wb * count(spring.b);
        SpringTerms<Real>& terms = solids.spring_terms()[k];
        terms.weights = wa + wb;
        terms.split = split;
        terms.compliance = physics::spring_compliance(spring.rule, wa + wb, h);
    });
    for_each_in_block(2 * model.springs, [&](int e) {
        const Incidence* const incidence = solids.spring_incidence() + e;
        const int k = incidence->constraint, a = solids.spring()[k].a, b = solids.spring()[k].b;
        // Of a spring that has both its ends on a solid, the first incidence is before the other.
        const bool of_a = a != b ? incidence->other == b : e == 0 || incidence[-1].constraint != k;
        SpringTerms<Real>& terms = solids.spring_terms()[k];
        (of_a ? terms.incidence_of_a : terms.incidence_of_b) = e;
    });
    for_each_in_block(model.clusters, [&](int k) {
        solids.compliance()[k] =
            static_cast<Real>(physics::relative_compliance(solids.cluster()[k].softness, static_cast<double>(h)));
    });
    __syncthreads();
}

/// Each thread has moved its own solids in the end.
template <class Real, class Solids>
__device__ void solve_springs(const ModelView<Real>& model, const Solids& solids) {
    for_each_in_block(model.springs, [&](int k) {
        const int a = solids.spring()[k].a, b = solids.spring()[k].b;
        const SpringTerms<Real> terms = solids.spring_terms()[k];
        const Vec3<Real> push = physics::xpbd_spring_push(xyz(position_of(solids, a)) - xyz(position_of(solids, b)),
                                                          terms.weights, terms.split, solids.rest_length()[k],
                                                          terms.compliance, solids.spring_lambda()[k]);
        solids.spring_push()[terms.incidence_of_a] = quad(push, Real(0));
        solids.spring_push()[terms.incidence_of_b] = {-push.x, -push.y, -push.z, Real(0)};
    });
    __syncthreads();
    for_each_in_block(model.solids, [&](int solid) {
        const int begin = solids.spring_incidences_begin()[solid], end = solids.spring_incidences_begin()[solid + 1];
        const Real inverse_mass = position_of(solids, solid).w;
        if (begin == end || !(inverse_mass > 0)) return;
        Vec3<Real> sum{0, 0, 0};
#pragma unroll 4
        for (int e = begin; e < end; ++e) sum = sum + inverse_mass * xyz(solids.spring_push()[e]);
        move_by_internal(model, solids, solid, sum);
    });
}

/// Centres and covariances of all clusters, in double, by a warp for each.
template <class Real, class Solids>
__device__ void sum_up_clusters(const ModelView<Real>& model, const Solids& solids) {
    const int lane = static_cast<int>(threadIdx.x) % 32, warps = static_cast<int>(blockDim.x) / 32;
    const auto place_of = [&](int m) { return physics::cast<double>(xyz(position_of(solids, solids.member()[m]))); };
#pragma unroll 1
    for (int k = static_cast<int>(threadIdx.x) / 32; k < model.clusters; k += warps) {
        const int first = solids.cluster()[k].begin + lane, end = solids.cluster()[k].end;
        Vec3<double> sum{};
        double total = 0;
#pragma unroll 1  // as all of an iteration's code is read from the instructions' cache
        for (int m = first; m < end; m += 32) {
            const double mass = solids.member_mass()[m];
            sum += mass * place_of(m);
            total += mass;
        }
        const double own = share_sums_of_warp<4>({sum.x, sum.y, sum.z, total}, lane);
        const double mean = own / of_value<4>(own, 3);
        const Vec3<double> centre{of_value<4>(mean, 0), of_value<4>(mean, 1), of_value<4>(mean, 2)};
        physics::Covariance covariance;
#pragma unroll 1
        for (int m = first; m < end; m += 32)
            add_arm(covariance, static_cast<double>(solids.member_mass()[m]), place_of(m) - centre,
                    physics::cast<double>(solids.offset()[m]));
        const double entry = share_sums_of_warp<9>(covariance.entry, lane);
        ClusterPose& pose = solids.cluster_pose()[k];
        if (lane == 0) pose.centre = centre;
        if (const int e = value_of_lane<9>(lane); e >= 0) pose.covariance.entry[e] = entry;
    }
}

/// Rotations of all clusters, a thread for each: a fit is one chain of arithmetic in double, and where all threads of a
/// warp do the same, warps wait for each other's arithmetic in double. Neighbours go to different warps, and so to
/// different schedulers.
template <class Real, class Solids>
__device__ void fit_clusters(const ModelView<Real>& model, const Solids& solids) {
    constexpr int schedulers = 4;
    const int warp = static_cast<int>(threadIdx.x) / 32, lane = static_cast<int>(threadIdx.x) % 32;
    if (warp >= schedulers) return;
    for (int k = lane * schedulers + warp; k < model.clusters; k += 32 * schedulers) {
        if (!isfinite(solids.compliance()[k])) continue;
        ClusterPose& pose = solids.cluster_pose()[k];
        ClusterFit<Real>& fit = solids.fit()[k];
        const physics::Covariance covariance = pose.covariance;
        double q[4] = {fit.rotation[0], fit.rotation[1], fit.rotation[2], fit.rotation[3]};
        physics::closest_rotation(covariance, q);
        physics::rotation_matrix(q, pose.rotation);
        for (int e = 0; e < 4; ++e) fit.rotation[e] = static_cast<Real>(q[e]);
        fit.centre = physics::cast<Real>(pose.centre);
    }
}

/// Correction of a cluster to one of its members.
template <class Real, class Solids>
__device__ Vec3<Real> push_of_incidence(const Solids& solids, const Incidence& incidence) {
    const int k = incidence.constraint, m = incidence.other;
    const Real alpha = solids.compliance()[k];
    if (!isfinite(alpha)) return {0, 0, 0};
    const ClusterPose& pose = solids.cluster_pose()[k];
    const Vec4<Real> here = position_of(solids, solids.member()[m]);
    Vec3<Real> displacement = xyz(solids.member_displacement()[m]);
    const Vec3<Real> change =
        compliant_goal_change(pose.centre, pose.rotation, solids.offset()[m], xyz(here), alpha, displacement);
    solids.member_displacement()[m] = quad(displacement, Real(0));
    return solids.member_mass()[m] * here.w * change;
}

/// Begins with a barrier; each thread has moved its own solids in the end.
template <class Real, class Solids>
__device__ void solve_clusters(const ModelView<Real>& model, const Solids& solids) {
    __syncthreads();
    sum_up_clusters(model, solids);
    __syncthreads();
    fit_clusters(model, solids);
    __syncthreads();
    for_each_in_block(model.members, [&](int e) {
        solids.cluster_push()[e] = quad(push_of_incidence<Real>(solids, solids.cluster_incidence()[e]), Real(0));
    });
    __syncthreads();
    for_each_in_block(model.solids, [&](int solid) {
        const int begin = solids.cluster_incidences_begin()[solid], end = solids.cluster_incidences_begin()[solid + 1];
        if (begin == end || !(position_of(solids, solid).w > 0)) return;
        Vec3<Real> sum{0, 0, 0};
#pragma unroll 1
        for (int e = begin; e < end; ++e) sum = sum + xyz(solids.cluster_push()[e]);
        move_by_internal(model, solids, solid, sum);
    });
}

/// Moves what is at a place out of the planes near it, one after the other.
template <class Real, class Solids>
__device__ void solve_planes_of(const ModelView<Real>& model, const Solids& solids, int place) {
    const Vec4<Real> here = solids.position()[place];
    Vec3<Real> x = xyz(here), predicted, displacement, start;
    bool moved = false;
    for_each_near_plane(model, solids, place, x, [&](const physics::PlaneSurface<Real>& plane, Real distance) {
        const Real depth = model.collision_distance - distance;
        if (!(depth > 0)) return;
        if (!moved) {
            predicted = xyz(solids.predicted_position()[place]);
            displacement = xyz(solids.displacement()[place]);
            start = xyz(solids.start()[place]);
            moved = true;
        }
        displacement = resolve_plane_penetration(displacement, depth, plane.normal, plane_friction(model),
                                                 [&](const Vec3<Real>& to) { return predicted + to - start; });
        x = predicted + displacement;
    });
    if (!moved) return;
    solids.displacement()[place] = quad(displacement, Real(0));
    solids.position()[place] = quad(x, here.w);
}

/// All iterations of a substep of length h, s. solve_contacts() ends with a barrier, as this does.
template <class Real, class Solids, class Contacts>
__device__ void iterate_solids(const ModelView<Real>& model, const Solids& solids, Real h,
                               const Contacts& solve_contacts) {
    prepare_constraints(model, solids, h);
    for (int k = 0; k < model.solid_iterations; ++k) {
        solve_contacts();
        if (model.plan.springs) solve_springs(model, solids);
        if (model.plan.clusters) solve_clusters(model, solids);
        for_each_in_block(model.solids, [&](int solid) { solve_planes_of(model, solids, solids.place(solid)); });
        __syncthreads();
    }
}

}  // namespace natator::cuda
