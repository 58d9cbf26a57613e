#pragma once

// Scheme flex: its iteration and its velocities. As step.h and the files of cpu/flex.
#include "effects.cuh"
#include "rotation.cuh"

namespace natator::cuda {

/// rho_i - 1 of the fluid in a slot. As cpu/flex/density.cpp.
template <class Real, class Block>
__device__ Real compression_of(const ModelView<Real>& model, const Block& block, int s, const Vec3<Real>& x) {
    const auto closeness_squared = [&](int other) {
        const Real t = max(1 - separation(x, xyz(block.position()[other])).r * model.inverse_radius, Real(0));
        return t * t;
    };
    Real sum = 0;
    for_each_neighbour(model, block, s, [&](int other) { sum += closeness_squared(other); });
    if (model.plan.solid_pressure) {
        Real solids = 0;
        for_each_contact(model, block, s, [&](int other) { solids += closeness_squared(other); });
        sum += model.solid_pressure * solids;
    }
    return sum * model.density_scale - 1;
}

/// Fits the rotation and centre of cluster k, by one warp. As cpu/flex/clusters.cpp.
template <class Real, class Block>
__device__ void fit_cluster(const ModelView<Real>& model, const Block& block, int k) {
    const int lane = threadIdx.x % 32;
    const ClusterView<Real> cluster = model.cluster[k];
    const auto place = [&](int m) { return xyz(block.position()[block.slot_of_solid()[model.member[m]]]); };
    const auto sum_of_warp = [](double value) {
        for (int step = 16; step > 0; step /= 2) value += __shfl_xor_sync(0xffffffff, value, step);
        return value;
    };
    double sum[3] = {};
    for (int m = cluster.begin + lane; m < cluster.end; m += 32) {
        const Vec3<Real> x = place(m);
        sum[0] += x.x;
        sum[1] += x.y;
        sum[2] += x.z;
    }
    const int count = cluster.end - cluster.begin;
    const Vec3<Real> mean{static_cast<Real>(sum_of_warp(sum[0]) / count),
                          static_cast<Real>(sum_of_warp(sum[1]) / count),
                          static_cast<Real>(sum_of_warp(sum[2]) / count)};
    double covariance[9] = {};  // row: of the arm, column: of the rest offset
    for (int m = cluster.begin + lane; m < cluster.end; m += 32) {
        const Vec3<Real> arm = place(m) - mean, offset = model.offset[m];
        const Real a[3] = {arm.x, arm.y, arm.z}, b[3] = {offset.x, offset.y, offset.z};
        for (int e = 0; e < 9; ++e) covariance[e] += a[e / 3] * b[e % 3];
    }
    for (double& entry : covariance) entry = sum_of_warp(entry);

    ClusterFit<Real>& fit = block.fit()[k];
    double q[4] = {fit.rotation[0], fit.rotation[1], fit.rotation[2], fit.rotation[3]};
    __syncwarp();
    constexpr int steps = 4;
    fit_rotation(covariance, q, steps);
    constexpr double centre_dead_band = 1e-5;
    if (lane == 0) {
        const Real rounded[4] = {static_cast<Real>(q[0]), static_cast<Real>(q[1]), static_cast<Real>(q[2]),
                                 static_cast<Real>(q[3])};
        for (int e = 0; e < 4; ++e) fit.rotation[e] = rounded[e];
        rotation_matrix(rounded, fit.matrix);
        if (fabs(mean.x - fit.centre.x) > Real(centre_dead_band)) fit.centre.x = mean.x;
        if (fabs(mean.y - fit.centre.y) > Real(centre_dead_band)) fit.centre.y = mean.y;
        if (fabs(mean.z - fit.centre.z) > Real(centre_dead_band)) fit.centre.z = mean.z;
    }
    __syncwarp();
}

/// What the constraints of one slot add up to.
template <class Real>
struct Correction {
    Vec3<Real> sum{0, 0, 0};
    Real constraints = 0;
};

/// Writes what the contacts of the slots in a unit push them by. As cpu/flex/contacts.cpp.
template <class Real, class Block>
__device__ void push_touched(const ModelView<Real>& model, const Block& block, int unit) {
    work_on_touched(block, unit, [&](int s, int lane) {
        Correction<Real> push;
        if (s >= 0) {
            const Quad<Real> here = block.position()[s];
            for_each_contact_of(model, block, s, lane, contact_lanes, [&](int other) {
                const Quad<Real> there = block.position()[other];
                const Vec3<Real> difference = xyz(here) - xyz(there);
                const Real r = norm(difference);
                const Real depth = model.solid_rest_distance - r;
                if (!(depth > 0)) return;
                const Real weights = here.w + there.w;
                const Real share = weights > 0 ? here.w / weights : Real(0);
                const Vec3<Real> normal = r > 0 ? (1 / r) * difference : Vec3<Real>{0, 0, 0};
                Vec3<Real> by = depth * normal;
                if (model.plan.particle_friction) {
                    const Vec3<Real> moved =
                        (xyz(here) - xyz(block.start()[s])) - (xyz(there) - xyz(block.start()[other]));
                    by = by - friction(model, moved, normal, depth, model.particle_friction);
                }
                push.sum = push.sum + share * by;
                push.constraints += 1;
            });
        }
        const Quad<Real> all{sum_of_lanes(push.sum.x), sum_of_lanes(push.sum.y), sum_of_lanes(push.sum.z),
                             sum_of_lanes(push.constraints)};
        if (s >= 0 && lane == 0) block.contact_push()[s] = all;
    });
}

/// rho_i - 1, but at least `least`, beside the positions in `next`; and all that depends on positions alone: fits of
/// clusters and pushes of contacts. Ends with a barrier.
template <class Real, class Block>
__device__ void compute_density(const ModelView<Real>& model, Block& block, Real least) {
    const int touched = touched_units<Real>(model, block), slots = (model.particles + 31) / 32;
    for_each_unit(block, model.clusters + touched + slots, [&](int unit) {
        if (unit < model.clusters) return fit_cluster(model, block, unit);
        if (unit < model.clusters + touched) return push_touched(model, block, unit - model.clusters);
        const int s = (unit - model.clusters - touched) * 32 + threadIdx.x % 32;
        if (s >= model.particles) return;
        const Vec3<Real> x = xyz(block.position()[s]);
        block.next()[s] = quad(x, s < model.fluid ? max(compression_of(model, block, s, x), least) : Real(0));
    });
    __syncthreads();
}

/// Dx_i = w_i R sum_j 1/2 (C_i + C_j) (1 - r/R) n. As cpu/flex/density.cpp.
template <class Real, class Block>
__device__ Correction<Real> density_constraint(const ModelView<Real>& model, const Block& block, int s,
                                               const Quad<Real>& here, Real inverse_mass) {
    Correction<Real> correction;
    Vec3<Real> sum{0, 0, 0};
    for_each_neighbour(model, block, s, [&](int other) {
        const Quad<Real> there = block.next()[other];
        const auto [difference, r, inverse_r] = separation(xyz(here), xyz(there));
        const Real left = 1 - r * model.inverse_radius;
        sum = sum + (here.w + there.w) * max(left, Real(0)) * inverse_r * difference;
        correction.constraints += left > 0 ? Real(1) : Real(0);
    });
    correction.sum = inverse_mass * model.radius * Real(0.5) * sum;
    return correction;
}

/// As cpu/flex/springs.cpp and the second half of clusters.cpp, seen from one particle.
template <class Real, class Block>
__device__ void add_springs_and_clusters(const ModelView<Real>& model, const Block& block, int solid,
                                         const Vec3<Real>& x, Real inverse_mass, Correction<Real>& correction) {
    for (int e = model.spring_shares_begin[solid]; e < model.spring_shares_begin[solid + 1]; ++e) {
        const Share share = model.spring_share[e];
        const Real weights = inverse_mass + model.inverse_mass[model.fluid + share.other];
        const Vec3<Real> difference = x - xyz(block.next()[block.slot_of_solid()[share.other]]);
        const Real length = norm(difference);
        correction.constraints += 1;
        if (!(weights > 0 && length > 0)) continue;
        const Real stretch = block.rest_length()[share.constraint] - length;
        const Real scale = inverse_mass * (model.spring[share.constraint].stiffness * stretch / weights / length);
        correction.sum = correction.sum + scale * difference;
    }
    for (int e = model.cluster_shares_begin[solid]; e < model.cluster_shares_begin[solid + 1]; ++e) {
        const Share share = model.cluster_share[e];
        const ClusterFit<Real>& fit = block.fit()[share.constraint];
        const Vec3<Real> offset = model.offset[share.other];
        const Real* const r = fit.matrix;
        const Vec3<Real> turned{r[0] * offset.x + r[1] * offset.y + r[2] * offset.z,
                                r[3] * offset.x + r[4] * offset.y + r[5] * offset.z,
                                r[6] * offset.x + r[7] * offset.y + r[8] * offset.z};
        correction.sum = correction.sum + model.cluster[share.constraint].stiffness * (fit.centre + turned - x);
        correction.constraints += 1;
    }
}

/// As cpu/flex/planes.cpp.
template <class Real, class Block>
__device__ Vec3<Real> solve_planes(const ModelView<Real>& model, const Block& block, int s, Vec3<Real> x) {
    const unsigned near = block.plane_contact()[s];
    if (near == 0) return x;
    for (int k = model.planes - 1; k >= 0; --k) {
        if (!(near >> k & 1)) continue;
        const PlaneView<Real>& plane = model.plane[k];
        const Real depth = model.collision_distance - (dot(plane.normal, x) + plane.offset);
        if (!(depth > 0)) continue;
        x = x + depth * plane.normal;
        if (model.plan.plane_friction)
            x = x - friction(model, x - xyz(block.start()[s]), plane.normal, depth, model.dynamic_friction);
    }
    return x;
}

/// Every correction from the same positions, summed, relaxed and applied, planes last.
template <class Real, class Block>
__device__ void apply_corrections(const ModelView<Real>& model, Block& block) {
    const int units = (model.particles + 31) / 32;
    for_each_unit(block, units, [&](int unit) {
        const int s = (units - 1 - unit) * 32 + threadIdx.x % 32;  // the last slots first: solids take longest
        if (s >= model.particles) return;
        const Quad<Real> here = block.next()[s];
        const Vec3<Real> x = xyz(here);
        const Real inverse_mass = block.position()[s].w;
        Correction<Real> correction;
        if (s < model.fluid) {
            correction = density_constraint(model, block, s, here, inverse_mass);
            if (model.plan.cohesion) correction.sum = correction.sum + inverse_mass * cohesion_push(model, block, s, x);
        } else {
            add_springs_and_clusters(model, block, block.number()[s] - model.fluid, x, inverse_mass, correction);
        }
        if (model.plan.contacts && block.contact_count()[s] > 0) {
            const Quad<Real> push = block.contact_push()[s];
            correction.sum = correction.sum + xyz(push);
            correction.constraints += push.w;
        }
        const Real omega = model.relaxation_factor;
        const Real scale =
            model.local_relaxation ? min(Real(1), (1 + omega) / max(correction.constraints, Real(1))) : omega;
        const Vec3<Real> moved = x + scale * correction.sum;
        block.position()[s] = quad(solve_planes(model, block, s, moved), inverse_mass);
    });
}

/// One constraint iteration. As iterate_summed in step.h. Ends with a barrier.
template <class Real, class Block>
__device__ void iterate_summed(const ModelView<Real>& model, Block& block) {
    compute_density(model, block, Real(0));
    block.book(Stage::density);
    apply_corrections(model, block);
    __syncthreads();
    block.book(Stage::corrections);
}

/// What slot s moved by per second.
template <class Real, class Block>
__device__ Vec3<Real> moved_per_second(const Block& block, int s) {
    return 1 / block.h * (xyz(block.position()[s]) - xyz(block.start()[s]));
}

/// The velocity that slot s leaves the substep with; for viscosity `next` holds what the fluid moved by per second. As
/// cpu/flex/velocities.cpp.
template <class Real, class Block>
__device__ Vec3<Real> new_velocity(const ModelView<Real>& model, const Block& block, int s) {
    const Vec3<Real> x = xyz(block.position()[s]), u = moved_per_second<Real>(block, s);
    Vec3<Real> v = u;
    if (model.plan.viscosity && s < model.fluid) {
        Vec3<Real> sum{0, 0, 0};
        for_each_neighbour(model, block, s, [&](int other) {
            const Real t = max(1 - separation(x, xyz(block.position()[other])).r * model.inverse_radius, Real(0));
            sum = sum + t * t * (xyz(block.next()[other]) - u);
        });
        v = v + block.h * model.viscosity * model.density_scale * sum;
    }
    if (model.plan.damping) v = v - block.h * model.damping * u;
    const Vec3<Real> predicted = xyz(block.drift()[s]);
    if (model.plan.clamp_acceleration) v = predicted + clamped(v - predicted, model.max_acceleration * block.h);
    if (model.plan.clamp_speed) v = clamped(v, model.max_speed);
    if (model.plan.dissipation) v = kept_by_dissipation(model, block, s) * v;
    if (model.plan.restitution) v = rebound(model, block, s, x, predicted, v);
    return v;
}

/// True if all that this thread wrote is finite.
template <class Real, class Block>
__device__ bool update_velocities(const ModelView<Real>& model, Block& block) {
    if (model.plan.viscosity) {
        for (int s = threadIdx.x; s < model.fluid; s += threads)
            block.next()[s] = quad(moved_per_second<Real>(block, s), Real(0));
        __syncthreads();
    }
    bool finite = true;
    for_each_unit(block, (model.particles + 31) / 32, [&](int unit) {
        const int s = unit * 32 + threadIdx.x % 32;
        if (s >= model.particles) return;
        const Quad<Real> here = block.position()[s];
        const Vec3<Real> v = new_velocity(model, block, s);
        finite &= isfinite(here.x + here.y + here.z) && isfinite(v.x + v.y + v.z);
        block.next_velocity()[s] = quad(here.w > 0 ? v : xyz(block.drift()[s]), Real(0));
    });
    return finite;
}

}  // namespace natator::cuda
