#pragma once

#include "contacts.cuh"
#include "rotation.cuh"

namespace natator::cuda {

/// Densities and compressions of the fluid. As cpu/flex/density.cpp.
template <class Real>
__device__ void compute_density(const ModelView<Real>& model, Block<Real>& block) {
    for (int s = threadIdx.x; s < model.fluid; s += threads) {
        const Vec3<Real> x = xyz(block.position[s]);
        const auto closeness_squared = [&](int other) {
            const Vec3<Real> difference = x - xyz(block.position[other]);
            const Real r2 = dot(difference, difference);
            const Real t = max(1 - r2 * inverse_root<Real>(r2 + tiny<Real>()) * model.inverse_radius, Real(0));
            return t * t;
        };
        Real sum = 0;
        const std::uint16_t* const list = block.neighbour + s;
        const int count = block.neighbour_count[s];
        for (int k = 0; k < count; ++k) sum += closeness_squared(list[k * static_cast<std::size_t>(model.fluid)]);
        if (model.plan.solid_pressure) {
            Real solids = 0;
            for_each_contact(model, block, s, [&](int other) { solids += closeness_squared(other); });
            sum += model.solid_pressure * solids;
        }
        block.compression[s] = sum * model.density_scale - 1;  // the constraint takes max(., 0) of it
    }
}

/// Fits the clusters' rotations and centres, one warp each, the last warps first. As cpu/flex/clusters.cpp.
template <class Real>
__device__ void fit_clusters(const ModelView<Real>& model, Block<Real>& block) {
    const int warp = threadIdx.x / 32, lane = threadIdx.x % 32;
    for (int k = warps - 1 - warp; k < model.clusters; k += warps) {
        const ClusterView<Real> cluster = model.cluster[k];
        const auto place = [&](int m) { return xyz(block.position[block.slot_of_solid[model.member[m]]]); };
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

        ClusterFit<Real>& fit = block.fit[k];
        double q[4] = {fit.rotation[0], fit.rotation[1], fit.rotation[2], fit.rotation[3]};
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
}

/// What the constraints of one slot add up to.
template <class Real>
struct Correction {
    Vec3<Real> sum{0, 0, 0};
    Real constraints = 0;
};

/// Dx_i = w_i R sum_j 1/2 (C_i + C_j) (1 - r/R) n. As cpu/flex/density.cpp.
template <class Real>
__device__ void add_density_constraint(const ModelView<Real>& model, const Block<Real>& block, int s,
                                       const Vec3<Real>& x, Real inverse_mass, Correction<Real>& correction) {
    const Real own = max(block.compression[s], Real(0));
    const std::uint16_t* const list = block.neighbour + s;
    const int count = block.neighbour_count[s];
    Vec3<Real> sum{0, 0, 0};
    for (int k = 0; k < count; ++k) {
        const int other = list[k * static_cast<std::size_t>(model.fluid)];
        const Vec3<Real> difference = x - xyz(block.position[other]);
        const Real r2 = dot(difference, difference);
        const Real inverse_r = inverse_root<Real>(r2 + tiny<Real>());
        const Real left = 1 - r2 * inverse_r * model.inverse_radius;
        const Real t = max(left, Real(0));
        sum = sum + (own + max(block.compression[other], Real(0))) * t * inverse_r * difference;
        correction.constraints += left > 0 ? Real(1) : Real(0);
    }
    correction.sum = inverse_mass * model.radius * Real(0.5) * sum;
}

/// As cpu/flex/contacts.cpp.
template <class Real>
__device__ void add_contacts(const ModelView<Real>& model, const Block<Real>& block, int s, const Vec3<Real>& x,
                             Real inverse_mass, Correction<Real>& correction) {
    for_each_contact(model, block, s, [&](int other) {
        const Vec3<Real> there = xyz(block.position[other]);
        const Vec3<Real> difference = x - there;
        const Real r = norm(difference);
        const Real depth = model.solid_rest_distance - r;
        if (!(depth > 0)) return;
        const Real weights = inverse_mass + block.drift[other].w;
        const Real share = weights > 0 ? inverse_mass / weights : Real(0);
        const Vec3<Real> normal = r > 0 ? (1 / r) * difference : Vec3<Real>{0, 0, 0};
        Vec3<Real> push = depth * normal;
        if (model.plan.particle_friction) {
            const Vec3<Real> moved = (x - xyz(block.start[s])) - (there - xyz(block.start[other]));
            push = push - friction(model, moved, normal, depth, model.particle_friction);
        }
        correction.sum = correction.sum + share * push;
        correction.constraints += 1;
    });
}

/// As cpu/flex/springs.cpp and the second half of clusters.cpp, seen from one particle.
template <class Real>
__device__ void add_springs_and_clusters(const ModelView<Real>& model, const Block<Real>& block, int solid,
                                         const Vec3<Real>& x, Real inverse_mass, Correction<Real>& correction) {
    for (int e = model.spring_shares_begin[solid]; e < model.spring_shares_begin[solid + 1]; ++e) {
        const Share share = model.spring_share[e];
        const int other = block.slot_of_solid[share.other];
        const Real weights = inverse_mass + block.drift[other].w;
        const Vec3<Real> difference = x - xyz(block.position[other]);
        const Real length = norm(difference);
        correction.constraints += 1;
        if (!(weights > 0 && length > 0)) continue;
        const Real stretch = block.rest_length[share.constraint] - length;
        const Real scale = inverse_mass * (model.spring[share.constraint].stiffness * stretch / weights / length);
        correction.sum = correction.sum + scale * difference;
    }
    for (int e = model.cluster_shares_begin[solid]; e < model.cluster_shares_begin[solid + 1]; ++e) {
        const Share share = model.cluster_share[e];
        const ClusterFit<Real>& fit = block.fit[share.constraint];
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
template <class Real>
__device__ Vec3<Real> solve_planes(const ModelView<Real>& model, const Block<Real>& block, int s, Vec3<Real> x) {
    const unsigned near = block.plane_contact[s];
    for (int k = model.planes - 1; k >= 0; --k) {
        if (!(near >> k & 1)) continue;
        const PlaneView<Real>& plane = model.plane[k];
        const Real depth = model.collision_distance - (dot(plane.normal, x) + plane.offset);
        if (!(depth > 0)) continue;
        x = x + depth * plane.normal;
        if (model.plan.plane_friction)
            x = x - friction(model, x - xyz(block.start[s]), plane.normal, depth, model.dynamic_friction);
    }
    return x;
}

/// One constraint iteration: every correction from the same positions, summed, relaxed and applied, planes last. As
/// iterate_summed in step.h.
template <class Real>
__device__ void iterate_summed(const ModelView<Real>& model, Block<Real>& block) {
    fit_clusters(model, block);
    if (model.plan.fluid) compute_density(model, block);
    __syncthreads();
    for (int s = threadIdx.x; s < model.particles; s += threads) {
        const Quad<Real> here = block.position[s];
        const Vec3<Real> x = xyz(here);
        const Real inverse_mass = block.drift[s].w;
        Correction<Real> correction;
        if (s < model.fluid) add_density_constraint(model, block, s, x, inverse_mass, correction);
        add_contacts(model, block, s, x, inverse_mass, correction);
        if (s >= model.fluid)
            add_springs_and_clusters(model, block, number_in(here.w) - model.fluid, x, inverse_mass, correction);
        const Real omega = model.relaxation_factor;
        const Real scale =
            model.local_relaxation ? min(Real(1), (1 + omega) / max(correction.constraints, Real(1))) : omega;
        Vec3<Real> moved = x + scale * correction.sum;
        block.next[s] = quad(solve_planes(model, block, s, moved), here.w);
    }
    __syncthreads();
    Quad<Real>* const swap = block.position;
    block.position = block.next;
    block.next = swap;
}

/// As cpu/flex/velocities.cpp. True if all that this thread wrote is finite.
template <class Real>
__device__ bool update_velocities(const ModelView<Real>& model, Block<Real>& block) {
    const Real inverse_h = 1 / block.h;
    Quad<Real>* const moved_per_second = block.next;
    if (model.plan.viscosity) {
        for (int s = threadIdx.x; s < model.fluid; s += threads)
            moved_per_second[s] = quad(inverse_h * (xyz(block.position[s]) - xyz(block.start[s])), Real(0));
        __syncthreads();
    }
    bool finite = true;
    for (int s = threadIdx.x; s < model.particles; s += threads) {
        const Quad<Real> here = block.position[s];
        const Vec3<Real> x = xyz(here);
        const Quad<Real> drift = block.drift[s];
        const Vec3<Real> u = inverse_h * (x - xyz(block.start[s]));
        Vec3<Real> v = u;
        if (model.plan.viscosity && s < model.fluid) {
            Vec3<Real> sum{0, 0, 0};
            const std::uint16_t* const list = block.neighbour + s;
            const int count = block.neighbour_count[s];
            for (int k = 0; k < count; ++k) {
                const int other = list[k * static_cast<std::size_t>(model.fluid)];
                const Vec3<Real> difference = x - xyz(block.position[other]);
                const Real r2 = dot(difference, difference);
                const Real t = max(1 - r2 * inverse_root<Real>(r2 + tiny<Real>()) * model.inverse_radius, Real(0));
                sum = sum + t * t * (xyz(moved_per_second[other]) - u);
            }
            v = v + block.h * model.viscosity * model.density_scale * sum;
        }
        if (model.plan.damping) v = v - block.h * model.damping * u;
        const Vec3<Real> predicted = xyz(drift);
        if (model.plan.clamp_acceleration) v = predicted + clamped(v - predicted, model.max_acceleration * block.h);
        if (model.plan.clamp_speed) v = clamped(v, model.max_speed);
        finite &= isfinite(x.x + x.y + x.z) && isfinite(v.x + v.y + v.z);
        block.next_velocity[s] = quad(drift.w > 0 ? v : predicted, Real(0));
    }
    return finite;
}

}  // namespace natator::cuda
