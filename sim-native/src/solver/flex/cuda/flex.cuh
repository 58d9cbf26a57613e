#pragma once

// Scheme flex: its iteration and its velocities.
#include "effects.cuh"
#include "physics/flex_density.h"
#include "physics/shape_matching.h"
#include "physics/spring.h"
#include "physics/velocity.h"

namespace natator::cuda {

/// 1 - r/R of a pair.
template <class Real>
__device__ Real kernel_argument(const ModelView<Real>& model, const Vec3<Real>& x, const Vec3<Real>& there) {
    return 1 - physics::length_of(x - there) * model.inverse_radius;
}

/// Part of a pair in the density at x.
template <class Real>
struct DensityPart {
    Real left;
    __device__ void add_to(physics::FlexDensity<Real>& sum) const { sum.add(left); }
};
template <class Real>
__device__ DensityPart<Real> density_part(const ModelView<Real>& model, const Vec3<Real>& x, const Vec3<Real>& there) {
    return {kernel_argument(model, x, there)};
}

/// rho_i - 1 of the fluid in a slot, whose fluid neighbours have this sum.
template <class Real, class Team>
__device__ Real compression_with(const ModelView<Real>& model, const Team& team, int s, const Vec3<Real>& x,
                                 const physics::FlexDensity<Real>& fluid) {
    physics::FlexDensity<Real> solids;
    if (model.plan.solid_pressure)
        for_each_contact(model, team, s,
                         [&](int other) { density_part(model, x, xyz(team.position()[other])).add_to(solids); });
    return fluid.density(model.solid_pressure * solids.sum, model.density_scale) - 1;
}
template <class Real, class Team>
__device__ Real compression_of(const ModelView<Real>& model, const Team& team, int s, const Vec3<Real>& x) {
    physics::FlexDensity<Real> fluid;
    for_each_neighbour(model, team, s,
                       [&](int other) { density_part(model, x, xyz(team.position()[other])).add_to(fluid); });
    return compression_with(model, team, s, x, fluid);
}

/// The product rounded by itself, as if it were stored: never fused with what it is added to.
__device__ inline float rounded_product(float a, float b) {
    return __fmul_rn(a, b);
}
__device__ inline double rounded_product(double a, double b) {
    return __dmul_rn(a, b);
}

/// physics::rotation_matrix with its products rounded in the same places in every kernel. Which of two products a sum
/// is fused with is else the compiler's choice, and another one in a block of a State's own than on the whole GPU.
template <class T>
__device__ void rotation_matrix(const T q[4], T m[9]) {
    const T x = q[0], y = q[1], z = q[2], w = q[3];
    const T xx = rounded_product(x, x), yy = rounded_product(y, y), xz = rounded_product(x, z);
    const T zw = rounded_product(z, w), xw = rounded_product(x, w);
    m[0] = 1 - 2 * fma(z, z, yy);
    m[1] = 2 * fma(x, y, -zw);
    m[2] = 2 * fma(y, w, xz);
    m[3] = 2 * fma(x, y, zw);
    m[4] = 1 - 2 * fma(z, z, xx);
    m[5] = 2 * fma(y, z, -xw);
    m[6] = 2 * fma(-y, w, xz);
    m[7] = 2 * fma(y, z, xw);
    m[8] = 1 - 2 * fma(y, y, xx);
}

/// Fits the rotation and centre of a cluster of `count` members, by one warp: place(m) is where member m is, offset(m)
/// its rest offset.
template <class Real, class Place, class Offset>
__device__ void fit_members(int count, ClusterFit<Real>& fit, const Place& place, const Offset& offset) {
    const int lane = threadIdx.x % 32;
    Vec3<double> sum{};
    for (int m = lane; m < count; m += 32) sum += physics::cast<double>(place(m));
    sum = {sum_of_warp(sum.x), sum_of_warp(sum.y), sum_of_warp(sum.z)};
    const Vec3<Real> mean = physics::cast<Real>(Vec3<double>{sum.x / count, sum.y / count, sum.z / count});
    physics::Covariance covariance;
    for (int m = lane; m < count; m += 32) add_arm(covariance, place(m) - mean, offset(m));
    for (double& entry : covariance.entry) entry = sum_of_warp(entry);

    double q[4] = {fit.rotation[0], fit.rotation[1], fit.rotation[2], fit.rotation[3]};
    __syncwarp();
    physics::fit_rotation(covariance, q, [](const double from[4], double matrix[9]) { rotation_matrix(from, matrix); });
    if (lane == 0) {
        for (int e = 0; e < 4; ++e) fit.rotation[e] = static_cast<Real>(q[e]);
        rotation_matrix(fit.rotation, fit.matrix);
        fit.centre = with_dead_band(fit.centre, mean);
    }
    __syncwarp();
}

/// Fits cluster k, by one warp.
template <class Real, class Team>
__device__ void fit_cluster(const ModelView<Real>& model, const Team& team, int k) {
    const int begin = model.cluster[k].begin, end = model.cluster[k].end;
    fit_members(
        end - begin, team.fit()[k],
        [&](int m) { return xyz(team.position()[team.slot_of_solid()[model.member[begin + m]]]); },
        [&](int m) { return model.offset[begin + m]; });
}

/// Sum of the corrections by the constraints of one slot.
template <class Real>
struct Correction {
    Vec3<Real> sum{0, 0, 0};
    Real constraints = 0;

    /// A push, times the factor beside it.
    __device__ void add(const Vec4<Real>& push) {
        sum += push.w * xyz(push);
        constraints += 1;
    }
};

/// What the contact of slot s, which is here, with another that is there pushes it by; w: its share of it. `push` is
/// called if they touch; start_of(slot) is where a slot was.
template <class Real, class Team, class StartOf, class Push>
__device__ void push_by_contact(const ModelView<Real>& model, const Team& team, int s, const Vec4<Real>& here,
                                int other, const Vec4<Real>& there, const StartOf& start_of, const Push& push) {
    const Vec3<Real> difference = xyz(here) - xyz(there);
    const Real r = norm(difference);
    const Real depth = model.solid_rest_distance - r;
    if (!(depth > 0)) return;
    const Vec3<Real> by = physics::contact_push(difference, r, depth, particle_friction(model), [&] {
        return (xyz(here) - start_of(s)) - (xyz(there) - start_of(other));
    });
    push(quad(by, physics::weight_share(here.w, partner_weight(model, team, s, other))));
}

/// Writes what the contacts of the slots in a task push them by.
template <class Real, class Team>
__device__ void solve_contacts(const ModelView<Real>& model, const Team& team, int task) {
    for_each_contact_slot(team, task, [&](int s, int lane) {
        Correction<Real> push;
        if (s >= 0) {
            const Vec4<Real> here = team.position()[s];
            for_each_contact_of(model, team, s, lane, pair_lanes, [&](int other) {
                push_by_contact(
                    model, team, s, here, other, team.position()[other],
                    [&](int slot) { return xyz(team.start()[slot]); }, [&](const Vec4<Real>& by) { push.add(by); });
            });
        }
        const Vec4<Real> all{sum_of_lanes(push.sum.x), sum_of_lanes(push.sum.y), sum_of_lanes(push.sum.z),
                             sum_of_lanes(push.constraints)};
        if (s >= 0 && lane == 0) team.contact_push()[s] = all;
    });
}

/// Writes rho_i - 1, but at least 0, of slot s, which is in x, beside its position in `scratch_position`.
template <class Real, class Team>
__device__ void set_compression(const ModelView<Real>& model, const Team& team, int s, const Vec3<Real>& x,
                                Real above) {
    if (model.plan.free_surface_drag && s < model.fluid) team.density()[s] = above + 1;
    team.scratch_position()[s] = quad(x, s < model.fluid ? max(above, Real(0)) : Real(0));
}
template <class Real, class Team>
__device__ void compute_density_of(const ModelView<Real>& model, const Team& team, int s) {
    const Vec3<Real> x = xyz(team.position()[s]);
    set_compression(model, team, s, x, s < model.fluid ? compression_of(model, team, s, x) : Real(0));
}

/// The densities of all slots, and what else depends on positions alone: fits of clusters and pushes of contacts. Ends
/// with a barrier.
template <class Real, class Team>
__device__ void compute_density(const ModelView<Real>& model, Team& team) {
    const int contact_tasks = contact_task_count<Real>(model, team), slots = (model.particles + 31) / 32;
    for_each_warp_task(team, model.clusters + contact_tasks, slots, [&](int task) {
        if (task < model.clusters) return fit_cluster(model, team, task);
        if (task < model.clusters + contact_tasks) return solve_contacts(model, team, task - model.clusters);
        const int s = (task - model.clusters - contact_tasks) * 32 + threadIdx.x % 32;
        if (s < model.particles) compute_density_of(model, team, s);
    });
    team.barrier();
}

/// What a pair adds to the push of what is here by the density constraint; w: rho - 1 of both.
template <class Real>
struct PushPart {
    Vec3<Real> difference;
    physics::Distance<Real> distance;
    Real left, compressions;
    __device__ void add_to(physics::FlexPush<Real>& sum) const { sum.add(difference, distance, left, compressions); }
};
template <class Real>
__device__ PushPart<Real> push_part(const ModelView<Real>& model, const Vec4<Real>& here, const Vec4<Real>& there) {
    const Vec3<Real> difference = xyz(here) - xyz(there);
    const physics::Distance<Real> distance = physics::distance_of(difference);
    return {difference, distance, 1 - distance.r * model.inverse_radius, here.w + there.w};
}

/// A spring as one of its ends sees it.
template <class Real>
struct SpringEnd {
    Vec3<Real> other;
    Real inverse_mass;  ///< of the other end
    Real rest_length;
    physics::SpringRule<Real> rule;
};
/// Springs `begin` .. `end` - 1 of one solid, by the `lanes` threads that share it; end_of(e) is how it sees spring e.
template <int lanes, class Real, class EndOf>
__device__ void add_springs(Correction<Real>& correction, const Vec3<Real>& x, Real inverse_mass, int begin, int end,
                            const EndOf& end_of) {
    add_in_order<lanes, Real>(
        begin, end,
        [&](int e) {
            const SpringEnd<Real> spring = end_of(e);
            return quad(physics::spring_push(x - spring.other, inverse_mass + spring.inverse_mass, spring.rest_length,
                                             spring.rule),
                        inverse_mass);
        },
        [&](const Vec4<Real>& push) { correction.add(push); });
}
/// A cluster as one of its members sees it.
template <class Real>
struct ClusterMember {
    const ClusterFit<Real>& fit;
    Vec3<Real> offset;  ///< of the member at rest
    Real stiffness;
};
/// Adds clusters `begin` .. `end` - 1 of one solid likewise; member_of(e) is how it sees cluster e.
template <int lanes, class Real, class MemberOf>
__device__ void add_clusters(Correction<Real>& correction, const Vec3<Real>& x, int begin, int end,
                             const MemberOf& member_of) {
    add_in_order<lanes, Real>(
        begin, end,
        [&](int e) {
            const ClusterMember<Real> member = member_of(e);
            return quad(physics::way_to_goal(member.fit.centre, member.fit.matrix, member.offset, x), member.stiffness);
        },
        [&](const Vec4<Real>& push) { correction.add(push); });
}

/// Corrections of one solid by its springs and clusters, by the `lanes` threads that share it; none if `solid` is -1.
template <int lanes, class Real, class Team>
__device__ Correction<Real> springs_and_clusters(const ModelView<Real>& model, const Team& team, int solid,
                                                 const Vec3<Real>& x, Real inverse_mass) {
    Correction<Real> correction;
    const auto begin = [solid](const int* incidences_begin) { return solid < 0 ? 0 : incidences_begin[solid]; };
    const auto end = [solid](const int* incidences_begin) { return solid < 0 ? 0 : incidences_begin[solid + 1]; };
    add_springs<lanes>(correction, x, inverse_mass, begin(model.spring_incidences_begin),
                       end(model.spring_incidences_begin), [&](int e) {
                           const Incidence incidence = model.spring_incidence[e];
                           return SpringEnd<Real>{xyz(team.scratch_position()[team.slot_of_solid()[incidence.other]]),
                                                  model.inverse_mass[model.fluid + incidence.other],
                                                  team.rest_length()[incidence.constraint],
                                                  model.spring[incidence.constraint].rule};
                       });
    add_clusters<lanes>(correction, x, begin(model.cluster_incidences_begin), end(model.cluster_incidences_begin),
                        [&](int e) {
                            const Incidence incidence = model.cluster_incidence[e];
                            return ClusterMember<Real>{team.fit()[incidence.constraint], model.offset[incidence.other],
                                                       model.cluster[incidence.constraint].stiffness};
                        });
    return correction;
}

/// What a slot may be in contact with, known before its correction is.
struct SlotContacts {
    unsigned planes;  ///< bit k: plane k may be touched
    bool contacts;
};
template <class Real, class Team>
__device__ SlotContacts slot_contacts(const ModelView<Real>& model, const Team& team, int s) {
    return {static_cast<unsigned>(team.plane_contact()[s]), model.plan.contacts && team.contact_count()[s] > 0};
}

template <class Real, class Team>
__device__ Vec3<Real> solve_planes(const ModelView<Real>& model, const Team& team, int s, unsigned near, Vec3<Real> x) {
    for_each_near_plane(model, near, x, [&](const physics::PlaneSurface<Real>& plane, Real distance) {
        const Real depth = model.collision_distance - distance;
        if (depth > 0)
            x = resolve_plane_penetration(x, depth, plane.normal, plane_friction(model),
                                          [&](const Vec3<Real>& to) { return to - xyz(team.start()[s]); });
    });
    return x;
}

/// Adds the contacts to the corrections of slot s, relaxes and applies the sum, planes last. Returns where it is then.
template <class Real, class Team>
__device__ Vec4<Real> apply(const ModelView<Real>& model, const Team& team, int s, const Vec3<Real>& x,
                            Real inverse_mass, Correction<Real> correction, const SlotContacts& touch) {
    if (touch.contacts) {
        const Vec4<Real> push = team.contact_push()[s];
        correction.sum = correction.sum + xyz(push);
        correction.constraints += push.w;
    }
    const Real scale = physics::relaxation(correction.constraints, model.relaxation_factor, model.local_relaxation);
    const Vec3<Real> moved = x + scale * correction.sum;
    return team.position()[s] = quad(solve_planes(model, team, s, touch.planes, moved), inverse_mass);
}

/// Corrects the solids of a task, by so many threads each.
template <int lanes, class Real, class Team>
__device__ void correct_solids(const ModelView<Real>& model, const Team& team, int task) {
    const int s = model.fluid + (task * 32 + threadIdx.x % 32) / lanes;
    const bool there = s < model.particles;
    if (lanes == 1 && !there) return;
    const Vec4<Real> here = team.scratch_position()[there ? s : model.particles];
    const Real inverse_mass = team.position()[there ? s : model.particles].w;
    const int solid = there ? team.number()[s] - model.fluid : -1;
    const auto correction = springs_and_clusters<lanes>(model, team, solid, xyz(here), inverse_mass);
    if (there && threadIdx.x % lanes == 0)
        apply(model, team, s, xyz(here), inverse_mass, correction, slot_contacts(model, team, s));
}

/// Tasks of apply_corrections that the solids make, with one thread or several for each.
template <class Real>
__host__ __device__ int solid_tasks(const ModelView<Real>& model, bool shared) {
    const int slots_of_task = shared ? slots_of_warp : 32;
    return (model.solids + slots_of_task - 1) / slots_of_task;
}

/// Corrects fluid slot s; push_of(here) is what the density constraint pushes it by.
template <class Real, class Team, class PushOf>
__device__ void correct_fluid(const ModelView<Real>& model, const Team& team, int s, const PushOf& push_of) {
    const Vec4<Real> here = team.scratch_position()[s];
    const Real inverse_mass = team.position()[s].w;
    const SlotContacts touch = slot_contacts(model, team, s);
    const physics::FlexPush<Real> push = push_of(here);
    Correction<Real> correction{push.correction(inverse_mass, model.radius), push.constraints};
    if (model.plan.cohesion) correction.sum = correction.sum + inverse_mass * cohesion_push(model, team, s);
    apply(model, team, s, xyz(here), inverse_mass, correction, touch);
}
template <class Real, class Team>
__device__ void correct_fluid(const ModelView<Real>& model, const Team& team, int s) {
    correct_fluid(model, team, s, [&](const Vec4<Real>& here) {
        physics::FlexPush<Real> push;
        for_each_neighbour(model, team, s,
                           [&](int other) { push_part(model, here, team.scratch_position()[other]).add_to(push); });
        return push;
    });
}

/// Every correction from the same positions: first of the solids, which take longest.
template <class Real, class Team>
__device__ void apply_corrections(const ModelView<Real>& model, Team& team) {
    const int of_solids = solid_tasks(model, team.shares_solids()), of_fluid = fluid_tasks(model);
    for_each_warp_task(team, of_solids, of_fluid, [&](int task) {
        if (task < of_solids)
            return team.shares_solids() ? correct_solids<pair_lanes>(model, team, task)
                                        : correct_solids<1>(model, team, task);
        const int s = fluid_slot(task - of_solids, of_fluid);
        if (s < model.fluid) correct_fluid(model, team, s);
    });
}

/// Displacement of slot s in the substep, per second.
template <class Real, class Team>
__device__ Vec3<Real> displacement_rate(const Team& team, int s) {
    const Real frequency = 1 / team.h;
    const Vec3<Real> way = xyz(team.position()[s]) - xyz(team.start()[s]);
    return {rounded_product(frequency, way.x), rounded_product(frequency, way.y), rounded_product(frequency, way.z)};
}

/// Part of a pair in the viscosity at x, where the displacement per second is u.
template <class Real>
struct SmoothingPart {
    Real left;
    Vec3<Real> relative_velocity;
    __device__ void add_to(physics::FlexSmoothing<Real>& sum) const { sum.add(left, relative_velocity); }
};
template <class Real>
__device__ SmoothingPart<Real> smoothing_part(const ModelView<Real>& model, const Vec3<Real>& x, const Vec3<Real>& u,
                                              const Vec3<Real>& there, const Vec3<Real>& movement) {
    return {kernel_argument(model, x, there), movement - u};
}

template <class Real>
__device__ bool is_viscous(const ModelView<Real>& model, int s) {
    return model.plan.viscosity && s < model.fluid;
}

/// The velocity that slot s, which moved by u per second, leaves the substep with.
template <class Real, class Team>
__device__ Vec3<Real> velocity_with(const ModelView<Real>& model, const Team& team, int s, const Vec3<Real>& u,
                                    const physics::FlexSmoothing<Real>& smoothing) {
    const bool viscous = is_viscous(model, s);
    const Vec3<Real> predicted = xyz(team.predicted_velocity()[s]);
    const physics::VelocityRule<Real> rule{viscous,
                                           team.h * model.viscosity,
                                           model.plan.damping,
                                           team.h * model.damping,
                                           model.plan.clamp_acceleration,
                                           team.h * model.max_acceleration,
                                           model.plan.clamp_speed,
                                           model.max_speed};
    return flex_velocity(u, model.density_scale * smoothing.sum, predicted, rule);
}

/// The velocity that slot s leaves the substep with; movement_of(slot) is the displacement of a fluid slot per second.
template <class Real, class Team, class MovementOf>
__device__ Vec3<Real> new_velocity(const ModelView<Real>& model, const Team& team, int s,
                                   const MovementOf& movement_of) {
    const Vec3<Real> x = xyz(team.position()[s]), u = displacement_rate<Real>(team, s);
    physics::FlexSmoothing<Real> smoothing;
    if (is_viscous(model, s))
        for_each_neighbour(model, team, s, [&](int other) {
            smoothing_part(model, x, u, xyz(team.position()[other]), movement_of(other)).add_to(smoothing);
        });
    return velocity_with(model, team, s, u, smoothing);
}

/// Writes the velocity of slot s; true if it and the position are finite.
template <class Real, class Team>
__device__ bool set_new_velocity(const Team& team, int s, const Vec3<Real>& v) {
    const Vec4<Real> here = team.position()[s];
    team.scratch_velocity()[s] = quad(here.w > 0 ? v : xyz(team.predicted_velocity()[s]), Real(0));
    return isfinite(here.x + here.y + here.z) && isfinite(v.x + v.y + v.z);
}

/// True if all that this thread wrote is finite.
template <class Real, class Team>
__device__ bool update_velocities(const ModelView<Real>& model, Team& team) {
    // Where a barrier is dear, each works out what its neighbours moved by.
    constexpr bool stored = !Team::of_several_blocks;
    if (stored && model.plan.viscosity) {
        for (int s = team.thread(); s < model.fluid; s += team.size())
            team.scratch_position()[s] = quad(displacement_rate<Real>(team, s), Real(0));
        team.barrier();
    }
    const auto movement_of = [&](int s) {
        return stored ? xyz(team.scratch_position()[s]) : displacement_rate<Real>(team, s);
    };
    bool finite = true;
    for_each_warp_task(team, 0, (model.particles + 31) / 32, [&](int task) {
        const int s = task * 32 + threadIdx.x % 32;
        if (s >= model.particles) return;
        finite &= set_new_velocity(team, s, new_velocity(model, team, s, movement_of));
    });
    return finite;
}

}  // namespace natator::cuda
