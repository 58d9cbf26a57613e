#pragma once

// Contacts, springs, clusters and planes of scheme conserving, by one block of threads.
#include "cells.cuh"
#include "physics/shape_matching.h"
#include "physics/spring.h"
#include "search.cuh"

namespace natator::cuda {

/// Moves a slot: the displacement is kept apart from the place it started at, so that it is not rounded to it.
template <class Real>
__device__ void move(const Slots<Real>& slots, int s, const Vec3<Real>& by) {
    const Vec3<Real> displacement = xyz(slots.displacement()[s]) + by;
    slots.displacement()[s] = quad(displacement, Real(0));
    const Quad<Real> base = slots.base()[s];
    slots.position()[s] = quad(xyz(base) + displacement, base.w);
}

/// Depth of a contact beyond what this substep may leave of it.
template <class Real>
__device__ Real contact_depth(const ModelView<Real>& model, const Slots<Real>& slots, int s, int other) {
    const auto distance = [&](const Quad<Real>* places) { return norm(xyz(places[s]) - xyz(places[other])); };
    return physics::limited_depth(
        model.solid_rest_distance, distance(slots.position()), model.overlap_acceleration * slots.h * slots.h,
        [&] { return distance(slots.start()); }, [&] { return distance(slots.base()); });
}

/// Masses are split over the contacts that are not apart. Ends with a barrier.
template <class Real>
__device__ void solve_contacts(const ModelView<Real>& model, const Slots<Real>& slots) {
    const int units = touched_units<Real>(model, slots);
    for_each_unit(slots, units, 0, [&](int unit) {
        work_on_touched(slots, unit, [&](int s, int lane) {
            int active = 0;
            if (s >= 0)
                for_each_contact_of(model, slots, s, lane, pair_lanes,
                                    [&](int other) { active += contact_depth<Real>(model, slots, s, other) > 0; });
            active = sum_of_lanes(active);
            if (s >= 0 && lane == 0) slots.constraint_count()[s] = static_cast<std::uint16_t>(active);
        });
    });
    __syncthreads();
    for_each_unit(slots, units, 0, [&](int unit) {
        work_on_touched(slots, unit, [&](int s, int lane) {
            const Real inverse_mass = s >= 0 ? slots.position()[s].w : Real(0);
            const int active = s >= 0 ? slots.constraint_count()[s] : 0;
            Vec3<Real> sum{0, 0, 0};
            if (active > 0 && inverse_mass > 0)
                for_each_contact_of(model, slots, s, lane, pair_lanes, [&](int other) {
                    const Real depth = contact_depth<Real>(model, slots, s, other);
                    if (!(depth > 0)) return;
                    const Real share = physics::split_share(inverse_mass, static_cast<Real>(active),
                                                            partner_weight(model, slots, s, other),
                                                            static_cast<Real>(slots.constraint_count()[other]));
                    sum += share * contact_push(model, slots, s, other, depth);
                });
            const Quad<Real> push{sum_of_lanes(sum.x), sum_of_lanes(sum.y), sum_of_lanes(sum.z), Real(0)};
            if (s >= 0 && lane == 0) slots.contact_push()[s] = push;
        });
    });
    __syncthreads();
    for (int t = threadIdx.x; t < slots.shared().touched; t += slots.size()) {
        const int s = slots.touched()[t];
        if (slots.constraint_count()[s] > 0 && slots.position()[s].w > 0)
            move(slots, s, model.relaxation_factor * xyz(slots.contact_push()[s]));
    }
    __syncthreads();
}

/// Moves a solid by what its springs or clusters ask for, and books it as internal to its body.
template <class Real>
__device__ void move_by_internal(const ModelView<Real>& model, const Slots<Real>& slots, int solid, const Vec3<Real>& correction) {
    const Vec3<Real> by = model.relaxation_factor * correction;
    slots.internal()[solid] = quad(xyz(slots.internal()[solid]) + by, Real(0));
    move(slots, slots.slot_of_solid()[solid], by);
}

/// Ends with a barrier.
template <class Real>
__device__ void solve_springs(const ModelView<Real>& model, const Slots<Real>& slots) {
    const auto count = [&](int solid) {
        return static_cast<Real>(model.spring_shares_begin[solid + 1] - model.spring_shares_begin[solid]);
    };
    for (int k = threadIdx.x; k < model.springs; k += slots.size()) {
        const SpringView<Real> spring = model.spring[k];
        const Real wa = model.inverse_mass[model.fluid + spring.a], wb = model.inverse_mass[model.fluid + spring.b];
        const Vec3<Real> difference = xyz(slots.position()[slots.slot_of_solid()[spring.a]]) -
                                      xyz(slots.position()[slots.slot_of_solid()[spring.b]]);
        const Real split = wa * count(spring.a) + wb * count(spring.b);
        const Vec3<Real> push = physics::xpbd_spring_push(difference, wa + wb, split, slots.rest_length()[k],
                                                          spring.rule, slots.h, slots.spring_lambda()[k]);
        slots.spring_push()[k] = quad(push, Real(0));
    }
    __syncthreads();
    for (int solid = threadIdx.x; solid < model.solids; solid += slots.size()) {
        const int begin = model.spring_shares_begin[solid], end = model.spring_shares_begin[solid + 1];
        const Real inverse_mass = model.inverse_mass[model.fluid + solid];
        if (begin == end || !(inverse_mass > 0)) continue;
        Vec3<Real> sum{0, 0, 0};
        for (int e = begin; e < end; ++e) {
            const int spring = model.spring_share[e].constraint;
            const Real weight = model.spring[spring].a == solid ? inverse_mass : -inverse_mass;
            sum = sum + weight * xyz(slots.spring_push()[spring]);
        }
        move_by_internal(model, slots, solid, sum);
    }
    __syncthreads();
}

/// Calls visit(k, cluster, lane) for each cluster, by a warp for each.
template <class Real, class Visit>
__device__ void for_each_cluster(const ModelView<Real>& model, const Visit& visit) {
    const int lane = static_cast<int>(threadIdx.x) % 32;
    for (int k = static_cast<int>(threadIdx.x) / 32; k < model.clusters; k += static_cast<int>(blockDim.x) / 32) visit(k, model.cluster[k], lane);
}

/// A cluster's compliance relative to its masses; not finite if it asks for nothing.
template <class Real>
__device__ Real compliance_of(const ClusterView<Real>& cluster, Real h) {
    return static_cast<Real>(physics::relative_compliance(cluster.softness, static_cast<double>(h)));
}

/// Centres and covariances of all clusters, in double.
template <class Real, class PlaceOf>
__device__ void sum_up_clusters(const ModelView<Real>& model, const Slots<Real>& slots, const PlaceOf& place_of) {
    for_each_cluster(model, [&](int k, const ClusterView<Real>& cluster, int lane) {
        Vec3<double> sum{};
        double total = 0;
        for (int m = cluster.begin + lane; m < cluster.end; m += 32) {
            const double mass = model.member_mass[m];
            sum += mass * physics::cast<double>(place_of(m));
            total += mass;
        }
        total = sum_of_warp(total);
        const Vec3<double> centre{sum_of_warp(sum.x) / total, sum_of_warp(sum.y) / total, sum_of_warp(sum.z) / total};
        physics::Covariance covariance;
        for (int m = cluster.begin + lane; m < cluster.end; m += 32)
            add_arm(covariance, static_cast<double>(model.member_mass[m]), physics::cast<double>(place_of(m)) - centre,
                    physics::cast<double>(model.offset[m]));
        for (double& entry : covariance.entry) entry = sum_of_warp(entry);
        if (lane != 0) return;
        slots.cluster_pose()[k].centre = centre;
        slots.cluster_pose()[k].covariance = covariance;
    });
}

/// Rotations of all clusters, a thread for each: a fit takes many steps one after the other, and where all threads of a warp do the same,
/// warps wait for each other's arithmetic in double. Neighbours go to different warps, and so to different schedulers.
template <class Real>
__device__ void fit_clusters(const ModelView<Real>& model, const Slots<Real>& slots) {
    constexpr int schedulers = 4;
    const int warp = static_cast<int>(threadIdx.x) / 32, lane = static_cast<int>(threadIdx.x) % 32;
    if (warp >= schedulers) return;
    for (int k = lane * schedulers + warp; k < model.clusters; k += 32 * schedulers) {
        if (!isfinite(compliance_of(model.cluster[k], slots.h))) continue;
        ClusterPose& pose = slots.cluster_pose()[k];
        ClusterFit<Real>& fit = slots.fit()[k];
        double q[4] = {fit.rotation[0], fit.rotation[1], fit.rotation[2], fit.rotation[3]};
        physics::fit_rotation(pose.covariance, q, physics::most_fit_steps);
        for (int e = 0; e < 4; ++e) {
            pose.rotation[e] = q[e];
            fit.rotation[e] = static_cast<Real>(q[e]);
        }
        fit.centre = physics::cast<Real>(pose.centre);
    }
}

/// Ends with a barrier.
template <class Real>
__device__ void solve_clusters(const ModelView<Real>& model, const Slots<Real>& slots) {
    const auto place_of = [&](int m) { return xyz(slots.position()[slots.slot_of_solid()[model.member[m]]]); };
    sum_up_clusters(model, slots, place_of);
    __syncthreads();
    fit_clusters(model, slots);
    __syncthreads();
    for_each_cluster(model, [&](int k, const ClusterView<Real>& cluster, int lane) {
        const Real alpha = compliance_of(cluster, slots.h);
        const ClusterPose pose = slots.cluster_pose()[k];
        double r[9];
        physics::rotation_matrix(pose.rotation, r);
        for (int m = cluster.begin + lane; m < cluster.end; m += 32) {
            if (!isfinite(alpha)) {
                slots.member_push()[m] = {0, 0, 0, 0};
                continue;
            }
            Vec3<Real> displacement = xyz(slots.member_displacement()[m]);
            const Vec3<Real> change = compliant_goal_change(pose.centre, r, model.offset[m], place_of(m), alpha, displacement);
            slots.member_displacement()[m] = quad(displacement, Real(0));
            const Real inverse_mass = model.inverse_mass[model.fluid + model.member[m]];
            slots.member_push()[m] = quad(model.member_mass[m] * inverse_mass * change, Real(0));
        }
    });
    __syncthreads();
    for (int solid = threadIdx.x; solid < model.solids; solid += slots.size()) {
        const int begin = model.cluster_shares_begin[solid], end = model.cluster_shares_begin[solid + 1];
        if (begin == end || !(model.inverse_mass[model.fluid + solid] > 0)) continue;
        Vec3<Real> sum{0, 0, 0};
        for (int e = begin; e < end; ++e) sum = sum + xyz(slots.member_push()[model.cluster_share[e].other]);
        move_by_internal(model, slots, solid, sum);
    }
    __syncthreads();
}

/// Moves slot s out of the planes near it, one after the other.
template <class Real>
__device__ void solve_planes_of(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const Quad<Real> here = slots.position()[s];
    Vec3<Real> x = xyz(here), base, displacement, start;
    bool moved = false;
    for_each_near_plane(model, slots, s, x, [&](const physics::PlaneSurface<Real>& plane, Real distance) {
        const Real depth = model.collision_distance - distance;
        if (!(depth > 0)) return;
        if (!moved) {
            base = xyz(slots.base()[s]);
            displacement = xyz(slots.displacement()[s]);
            start = xyz(slots.start()[s]);
            moved = true;
        }
        displacement = resolve_plane_penetration(displacement, depth, plane.normal, plane_friction(model),
                                                 [&](const Vec3<Real>& to) { return base + to - start; });
        x = base + displacement;
    });
    if (!moved) return;
    slots.displacement()[s] = quad(displacement, Real(0));
    slots.position()[s] = quad(x, here.w);
}

}  // namespace natator::cuda
