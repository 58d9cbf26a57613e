#pragma once

// Scheme conserving: its iteration and its velocities.
#include "conserving_density.cuh"
#include "conserving_solids.cuh"
#include "effects.cuh"
#include "symmetric3.cuh"

namespace natator::cuda {

/// Ends with a barrier.
template <class Real, class Block>
__device__ void begin_iterations(const ModelView<Real>& model, Block& block) {
    const Quad<Real> zero{0, 0, 0, 0};
    block.overlapping = false;
    for (int s = threadIdx.x; s < model.particles; s += threads) {
        block.displacement()[s] = zero;
        block.active()[s] = 0;
        if (s < model.fluid) block.lambda_sum()[s] = 0;
    }
    for (int k = threadIdx.x; k < model.solids; k += threads) block.internal()[k] = zero;
    for (int k = threadIdx.x; k < model.springs; k += threads) block.spring_lambda()[k] = 0;
    for (int k = threadIdx.x; k < model.members; k += threads) block.member_displacement()[k] = zero;
    if (threadIdx.x == 0) block.lambda()[model.particles] = 0;
    if (model.plan.fluid) keep_mutual_neighbours(model, block);
    __syncthreads();
}

/// A warp per free body, the sums in double. Ends with a barrier.
template <class Real, class Block>
__device__ void keep_body_momentum(const ModelView<Real>& model, Block& block) {
    const int warp = threadIdx.x / 32, lane = threadIdx.x % 32;
    const auto sum_up = [](double* values, int count) {
        for (int e = 0; e < count; ++e)
            for (int step = 16; step > 0; step /= 2) values[e] += __shfl_xor_sync(0xffffffff, values[e], step);
    };
    const double inverse_h = 1 / static_cast<double>(block.h);
    for (int k = warp; k < model.free_bodies; k += warps) {
        const int begin = model.free_body_begin[k], end = model.free_body_begin[k + 1];
        double sums[7] = {};  // mass, mass * start, mass * position
        for (int e = begin + lane; e < end; e += 32) {
            const int solid = model.free_body_particle[e], s = block.slot_of_solid()[solid];
            const double mass = 1 / static_cast<double>(model.inverse_mass[model.fluid + solid]);
            const Quad<Real> from = block.start()[s], to = block.position()[s];
            const double add[7] = {mass,        mass * from.x, mass * from.y, mass * from.z,
                                   mass * to.x, mass * to.y,   mass * to.z};
            for (int a = 0; a < 7; ++a) sums[a] += add[a];
        }
        sum_up(sums, 7);
        double start_centre[3], centre[3];
        for (int axis = 0; axis < 3; ++axis) {
            start_centre[axis] = sums[1 + axis] / sums[0];
            centre[axis] = sums[4 + axis] / sums[0];
        }
        double totals[12] = {};  // momentum, moment, inertia: xx, yy, zz, xy, xz, yz
        for (int e = begin + lane; e < end; e += 32) {
            const int solid = model.free_body_particle[e], s = block.slot_of_solid()[solid];
            const double mass = 1 / static_cast<double>(model.inverse_mass[model.fluid + solid]);
            const Quad<Real> from = block.start()[s], to = block.position()[s], moved = block.internal()[solid];
            const double scale = mass * inverse_h;
            const double p[3] = {scale * moved.x, scale * moved.y, scale * moved.z};
            const double a[3] = {from.x - start_centre[0], from.y - start_centre[1], from.z - start_centre[2]};
            const double b[3] = {to.x - centre[0], to.y - centre[1], to.z - centre[2]};
            const double add[12] = {p[0],
                                    p[1],
                                    p[2],
                                    a[1] * p[2] - a[2] * p[1],
                                    a[2] * p[0] - a[0] * p[2],
                                    a[0] * p[1] - a[1] * p[0],
                                    mass * (b[1] * b[1] + b[2] * b[2]),
                                    mass * (b[0] * b[0] + b[2] * b[2]),
                                    mass * (b[0] * b[0] + b[1] * b[1]),
                                    -mass * b[0] * b[1],
                                    -mass * b[0] * b[2],
                                    -mass * b[1] * b[2]};
            for (int t = 0; t < 12; ++t) totals[t] += add[t];
        }
        sum_up(totals, 12);
        double angular[3];
        solve_least_norm(totals + 6, totals + 3, angular);
        if (lane == 0) {
            BodyMotion& motion = block.motion()[k];
            for (int axis = 0; axis < 3; ++axis) {
                motion.linear[axis] = -totals[axis] / sums[0];
                motion.angular[axis] = -angular[axis];
                motion.centre[axis] = centre[axis];
            }
        }
        __syncwarp();
        for (int e = begin + lane; e < end; e += 32) {
            const int s = block.slot_of_solid()[model.free_body_particle[e]];
            const Quad<Real> x = block.position()[s], v = block.next()[s];
            const BodyMotion& m = block.motion()[k];
            const double arm[3] = {x.x - m.centre[0], x.y - m.centre[1], x.z - m.centre[2]};
            const auto change = [&](int axis, int next, int last) {
                return static_cast<Real>(m.linear[axis] + m.angular[next] * arm[last] - m.angular[last] * arm[next]);
            };
            block.next()[s] = {v.x + change(0, 1, 2), v.y + change(1, 2, 0), v.z + change(2, 0, 1), v.w};
        }
    }
    __syncthreads();
}

/// Viscosity's part of a fluid slot's velocity: momenta are exchanged within pairs.
template <class Real, class Block>
__device__ Vec3<Real> viscosity_change(const ModelView<Real>& model, const Block& block, int s, const Vec3<Real>& x,
                                       const Quad<Real>& u) {
    physics::PairwiseSmoothing<Real> sums;
    for_each_neighbour(model, block, s, [&](int other) {
        const Quad<Real> moves = block.next()[other];
        sums.add(x - xyz(block.position()[other]), model.inverse_radius, u.w, moves.w, xyz(moves) - xyz(u));
    });
    return model.fluid_kernel.scale * sums.sum;
}

/// The velocity that the displacement of slot s means, with its inverse mass.
template <class Real, class Block>
__device__ Quad<Real> constrained_velocity(const Block& block, int s) {
    const Quad<Real> drift = block.drift()[s];
    return quad(xyz(drift) + (1 / block.h) * xyz(block.displacement()[s]), drift.w);
}

/// The velocity that slot s leaves the substep with, where `next` holds what the constraints left.
template <class Real, class Block>
__device__ Vec3<Real> velocity_in_turn(const ModelView<Real>& model, const Block& block, int s) {
    const Real smoothing = block.h * model.viscosity / (1 + 2 * block.h * model.viscosity);
    const Real kept = model.plan.damping ? 1 / (1 + block.h * model.damping) : Real(1);
    const Vec3<Real> x = xyz(block.position()[s]);
    const Quad<Real> u = block.next()[s];
    Vec3<Real> v = xyz(u);
    if (model.plan.viscosity && s < model.fluid) v = v + smoothing * viscosity_change(model, block, s, x, u);
    v = kept * v;
    if (model.plan.clamp_speed) v = clamped(v, model.max_speed);
    return v;
}

/// True if all that this thread wrote is finite.
template <class Real, class Block>
__device__ bool update_velocities_in_turn(const ModelView<Real>& model, Block& block) {
    for (int s = threadIdx.x; s < model.particles; s += threads) block.next()[s] = constrained_velocity<Real>(block, s);
    __syncthreads();
    if (model.free_bodies > 0) keep_body_momentum(model, block);
    if (model.plan.fluid) solve_density_rate(model, block);
    bool finite = true;
    for_each_unit(block, (model.particles + 31) / 32, [&](int unit) {
        const int s = unit * 32 + threadIdx.x % 32;
        if (s >= model.particles) return;
        const Vec3<Real> x = xyz(block.position()[s]);
        const Vec3<Real> v = velocity_in_turn(model, block, s);
        finite &= isfinite(x.x + x.y + x.z) && isfinite(v.x + v.y + v.z);
        block.next_velocity()[s] = quad(block.next()[s].w > 0 ? v : xyz(block.drift()[s]), Real(0));
    });
    return finite;
}

}  // namespace natator::cuda
