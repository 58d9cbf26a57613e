#pragma once

// Contacts, springs, clusters and planes of scheme conserving. As the files of cpu/conserving, which cite the papers.
#include "conserving_move.cuh"
#include "conserving_overlap.cuh"
#include "rotation.cuh"

namespace natator::cuda {

/// What one contact pushes slot s by, times (w_i n_i + w_j n_j) / w_i.
template <class Real, class Block>
__device__ Vec3<Real> contact_push(const ModelView<Real>& model, const Block& block, int s, int other, Real depth) {
    const Vec3<Real> x = xyz(block.position()[s]), there = xyz(block.position()[other]);
    const Vec3<Real> difference = x - there;
    const Real r = norm(difference);
    const Vec3<Real> normal = r > 0 ? (1 / r) * difference : Vec3<Real>{0, 0, 0};
    const Vec3<Real> push = depth * normal;
    if (!model.plan.particle_friction) return push;
    const Vec3<Real> moved = (x - xyz(block.start()[s])) - (there - xyz(block.start()[other]));
    return push - friction(model, moved, normal, depth, model.particle_friction);
}

/// Masses are split over the contacts that are not apart. Ends with a barrier.
template <class Real, class Block>
__device__ void solve_contacts(const ModelView<Real>& model, Block& block) {
    const int units = touched_units<Real>(model, block);
    for_each_unit(block, units, [&](int unit) {
        work_on_touched(block, unit, [&](int s, int lane) {
            int active = 0;
            if (s >= 0)
                for_each_contact_of(model, block, s, lane, contact_lanes,
                                    [&](int other) { active += contact_depth<Real>(model, block, s, other) > 0; });
            active = sum_of_lanes(active);
            if (s >= 0 && lane == 0) block.active()[s] = static_cast<std::uint16_t>(active);
        });
    });
    __syncthreads();
    for_each_unit(block, units, [&](int unit) {
        work_on_touched(block, unit, [&](int s, int lane) {
            const Real inverse_mass = s >= 0 ? block.position()[s].w : Real(0);
            const int active = s >= 0 ? block.active()[s] : 0;
            Vec3<Real> sum{0, 0, 0};
            if (active > 0 && inverse_mass > 0)
                for_each_contact_of(model, block, s, lane, contact_lanes, [&](int other) {
                    const Real depth = contact_depth<Real>(model, block, s, other);
                    if (!(depth > 0)) return;
                    const Real split = inverse_mass * static_cast<Real>(active) +
                                       block.position()[other].w * static_cast<Real>(block.active()[other]);
                    sum = sum + inverse_mass / split * contact_push(model, block, s, other, depth);
                });
            const Quad<Real> push{sum_of_lanes(sum.x), sum_of_lanes(sum.y), sum_of_lanes(sum.z), Real(0)};
            if (s >= 0 && lane == 0) block.contact_push()[s] = push;
        });
    });
    __syncthreads();
    for (int t = threadIdx.x; t < block.shared().touched; t += threads) {
        const int s = block.touched()[t];
        if (block.active()[s] > 0 && block.position()[s].w > 0)
            move(block, s, model.relaxation_factor * xyz(block.contact_push()[s]));
    }
    __syncthreads();
}

/// Moves a solid by what its springs or clusters ask for, and books it as internal to its body.
template <class Real, class Block>
__device__ void move_by_internal(const ModelView<Real>& model, Block& block, int solid, const Vec3<Real>& correction) {
    const Vec3<Real> by = model.relaxation_factor * correction;
    block.internal()[solid] = quad(xyz(block.internal()[solid]) + by, Real(0));
    move(block, block.slot_of_solid()[solid], by);
}

template <class Real>
__device__ Real compliance_at(double softness, Real h) {
    const double ratio = cpu::thesis_substep / static_cast<double>(h);
    return static_cast<Real>(softness * ratio * ratio);
}

/// Ends with a barrier.
template <class Real, class Block>
__device__ void solve_springs(const ModelView<Real>& model, Block& block) {
    const auto count = [&](int solid) {
        return static_cast<Real>(model.spring_shares_begin[solid + 1] - model.spring_shares_begin[solid]);
    };
    for (int k = threadIdx.x; k < model.springs; k += threads) {
        const SpringView<Real> spring = model.spring[k];
        const Real wa = model.inverse_mass[model.fluid + spring.a], wb = model.inverse_mass[model.fluid + spring.b];
        const Vec3<Real> difference = xyz(block.position()[block.slot_of_solid()[spring.a]]) -
                                      xyz(block.position()[block.slot_of_solid()[spring.b]]);
        const Real length = norm(difference);
        const Real alpha = compliance_at(spring.softness * static_cast<double>(wa + wb), block.h);
        Quad<Real> push{0, 0, 0, 0};
        if (isfinite(alpha) && wa + wb > 0 && length > 0) {
            const Real split = wa * count(spring.a) + wb * count(spring.b);
            const Real lambda = block.spring_lambda()[k];
            const Real change = (block.rest_length()[k] - length - alpha * lambda) / (split + alpha);
            block.spring_lambda()[k] = lambda + change;
            push = quad(change / length * difference, Real(0));
        }
        block.spring_push()[k] = push;
    }
    __syncthreads();
    for (int solid = threadIdx.x; solid < model.solids; solid += threads) {
        const int begin = model.spring_shares_begin[solid], end = model.spring_shares_begin[solid + 1];
        const Real inverse_mass = model.inverse_mass[model.fluid + solid];
        if (begin == end || !(inverse_mass > 0)) continue;
        Vec3<Real> sum{0, 0, 0};
        for (int e = begin; e < end; ++e) {
            const int spring = model.spring_share[e].constraint;
            const Real weight = model.spring[spring].a == solid ? inverse_mass : -inverse_mass;
            sum = sum + weight * xyz(block.spring_push()[spring]);
        }
        move_by_internal(model, block, solid, sum);
    }
    __syncthreads();
}

/// A warp per cluster, the sums in double. Ends with a barrier.
template <class Real, class Block>
__device__ void solve_clusters(const ModelView<Real>& model, Block& block) {
    const int warp = threadIdx.x / 32, lane = threadIdx.x % 32;
    const auto place = [&](int m) { return xyz(block.position()[block.slot_of_solid()[model.member[m]]]); };
    const auto sum_of_warp = [](double value) {
        for (int step = 16; step > 0; step /= 2) value += __shfl_xor_sync(0xffffffff, value, step);
        return value;
    };
    for (int k = warp; k < model.clusters; k += warps) {
        const ClusterView<Real> cluster = model.cluster[k];
        const Real alpha = compliance_at(cluster.softness, block.h);
        if (!isfinite(alpha)) {
            for (int m = cluster.begin + lane; m < cluster.end; m += 32) block.member_push()[m] = {0, 0, 0, 0};
            continue;
        }
        double sum[4] = {};
        for (int m = cluster.begin + lane; m < cluster.end; m += 32) {
            const double mass = model.member_mass[m];
            const Vec3<Real> x = place(m);
            sum[0] += mass * x.x;
            sum[1] += mass * x.y;
            sum[2] += mass * x.z;
            sum[3] += mass;
        }
        for (double& entry : sum) entry = sum_of_warp(entry);
        const double centre[3] = {sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3]};
        double covariance[9] = {};  // row: of the arm, column: of the rest offset
        for (int m = cluster.begin + lane; m < cluster.end; m += 32) {
            const Vec3<Real> x = place(m), offset = model.offset[m];
            const double mass = model.member_mass[m];
            const double arm[3] = {x.x - centre[0], x.y - centre[1], x.z - centre[2]};
            const double rest[3] = {offset.x, offset.y, offset.z};
            for (int e = 0; e < 9; ++e) covariance[e] += mass * arm[e / 3] * rest[e % 3];
        }
        for (double& entry : covariance) entry = sum_of_warp(entry);

        ClusterFit<Real>& fit = block.fit()[k];
        double q[4] = {fit.rotation[0], fit.rotation[1], fit.rotation[2], fit.rotation[3]};
        constexpr int most_steps = 20;  // the fit ends by itself once it has converged
        fit_rotation(covariance, q, most_steps);
        __syncwarp();
        if (lane == 0) {
            for (int e = 0; e < 4; ++e) fit.rotation[e] = static_cast<Real>(q[e]);
            fit.centre = {static_cast<Real>(centre[0]), static_cast<Real>(centre[1]), static_cast<Real>(centre[2])};
        }
        double r[9];
        rotation_matrix(q, r);
        for (int m = cluster.begin + lane; m < cluster.end; m += 32) {
            const Vec3<Real> x = place(m), offset = model.offset[m];
            const double rest[3] = {offset.x, offset.y, offset.z};
            const auto away = [&](int axis, Real now) {
                const double goal =
                    centre[axis] + r[3 * axis] * rest[0] + r[3 * axis + 1] * rest[1] + r[3 * axis + 2] * rest[2];
                return static_cast<Real>(goal - now);
            };
            const Vec3<Real> before = xyz(block.member_displacement()[m]);
            const Vec3<Real> change =
                1 / (1 + alpha) * (Vec3<Real>{away(0, x.x), away(1, x.y), away(2, x.z)} - alpha * before);
            block.member_displacement()[m] = quad(before + change, Real(0));
            const Real inverse_mass = model.inverse_mass[model.fluid + model.member[m]];
            block.member_push()[m] = quad(model.member_mass[m] * inverse_mass * change, Real(0));
        }
    }
    __syncthreads();
    for (int solid = threadIdx.x; solid < model.solids; solid += threads) {
        const int begin = model.cluster_shares_begin[solid], end = model.cluster_shares_begin[solid + 1];
        if (begin == end || !(model.inverse_mass[model.fluid + solid] > 0)) continue;
        Vec3<Real> sum{0, 0, 0};
        for (int e = begin; e < end; ++e) sum = sum + xyz(block.member_push()[model.cluster_share[e].other]);
        move_by_internal(model, block, solid, sum);
    }
    __syncthreads();
}

/// Moves slot s out of the planes near it, one after the other.
template <class Real, class Block>
__device__ void solve_planes_of(const ModelView<Real>& model, Block& block, int s) {
    const unsigned near = block.plane_contact()[s];
    if (near == 0) return;
    const Quad<Real> here = block.position()[s];
    Vec3<Real> x = xyz(here), base{}, displacement{}, start{};
    bool moved = false;
    for (int k = model.planes - 1; k >= 0; --k) {
        if (!(near >> k & 1)) continue;
        const PlaneView<Real>& plane = model.plane[k];
        const Real depth = model.collision_distance - (dot(plane.normal, x) + plane.offset);
        if (!(depth > 0)) continue;
        if (!moved) {
            base = xyz(block.base()[s]);
            displacement = xyz(block.displacement()[s]);
            start = xyz(block.start()[s]);
            moved = true;
        }
        displacement = displacement + depth * plane.normal;
        x = base + displacement;
        if (!model.plan.plane_friction) continue;
        displacement = displacement - friction(model, x - start, plane.normal, depth, model.dynamic_friction);
        x = base + displacement;
    }
    if (!moved) return;
    block.displacement()[s] = quad(displacement, Real(0));
    block.position()[s] = quad(x, here.w);
}

/// Ends with a barrier.
template <class Real, class Block>
__device__ void solve_planes_in_turn(const ModelView<Real>& model, Block& block) {
    for (int s = threadIdx.x; s < model.particles; s += threads) solve_planes_of(model, block, s);
    __syncthreads();
}

}  // namespace natator::cuda
