#pragma once

// The density constraint of scheme conserving.
#include "conserving_move.cuh"
#include "conserving_overlap.cuh"

namespace natator::cuda {

/// Minus the derivative of a plane's part of the density by the distance.
template <class Real>
__device__ Real plane_slope(const ModelView<Real>& model, Real distance) {
    const Real t = physics::plane_nearness(distance, model.plane_gap, model.inverse_radius);
    return physics::plane_slope(t, model.plane_scale, model.inverse_radius);
}

template <class Real, class Block>
__device__ physics::Boundary<Real> boundary_terms(const ModelView<Real>& model, const Block& block, int s,
                                                  const Vec3<Real>& x) {
    physics::Boundary<Real> boundary;
    for_each_near_plane(model, block, s, x, [&](const physics::PlaneSurface<Real>& plane, Real distance) {
        const Real t = physics::plane_nearness(distance, model.plane_gap, model.inverse_radius);
        boundary.density += physics::plane_density(t, model.plane_scale);
        boundary.gradient -= plane_slope(model, distance) * plane.normal;
    });
    if (model.plan.solid_pressure)
        for_each_contact(model, block, s, [&](int other) {
            const Quad<Real> there = block.position()[other];
            add_solid(boundary, x - xyz(there), model.inverse_radius, model.solid_pressure, model.fluid_kernel,
                      there.w);
        });
    return boundary;
}

/// C_i and its response.
template <class Real>
struct Density {
    Real above, response;
};

/// Of slot s, with the fluid at `positions`.
template <class Real, class Block>
__device__ Density<Real> density_of(const ModelView<Real>& model, const Block& block, int s,
                                    const Quad<Real>* positions, const physics::Boundary<Real>& boundary) {
    const Quad<Real> here = positions[s];
    physics::LambdaSums<Real> sums;
    for_each_neighbour(model, block, s, [&](int other) {
        const Quad<Real> there = positions[other];
        const Vec3<Real> difference = xyz(here) - xyz(there);
        const physics::Distance<Real> distance = physics::distance_of(difference);
        sums.add(difference, distance, 1 - distance.r * model.inverse_radius, there.w);
    });
    return {sums.above_rest(model.fluid_kernel, boundary.density),
            sums.gradients.response(here.w, model.fluid_kernel.gradient_scale, boundary.gradient, boundary.square)};
}

/// lambda of all fluid slots at the present positions, beside the positions in `next`; true if any is an overlap. Ends
/// with a barrier.
template <class Real, class Block>
__device__ bool compute_lambda(const ModelView<Real>& model, Block& block) {
    bool high = false;
    for_each_unit(block, (model.particles + 31) / 32, [&](int unit) {
        const int s = unit * 32 + threadIdx.x % 32;
        if (s >= model.particles) return;
        const Vec3<Real> x = xyz(block.position()[s]);
        Real lambda = 0;
        if (s < model.fluid) {
            const physics::Boundary<Real> boundary = boundary_terms(model, block, s, x);
            block.boundary()[s] = quad(boundary.gradient, boundary.square);
            const Density<Real> density = density_of(model, block, s, block.position(), boundary);
            if (block.overlapping)
                lambda = limited_lambda(model, block, s, density.above, density.response);
            else if (density.above > 0)
                lambda = -density.above * density.response;
            high |= density.above > Real(physics::overlap_tolerance);
            block.lambda_sum()[s] += lambda;
            if (model.plan.free_surface_drag) block.density()[s] = density.above + 1;
        }
        block.next()[s] = quad(x, lambda);
    });
    return __syncthreads_or(high);
}

/// C_i of all fluid slots at the present positions, beside the positions in `next`. Ends with a barrier.
template <class Real, class Block>
__device__ void compute_density_above_rest(const ModelView<Real>& model, Block& block) {
    for (int s = threadIdx.x; s < model.fluid; s += threads) {
        const Vec3<Real> x = xyz(block.position()[s]);
        const physics::Boundary<Real> boundary = boundary_terms(model, block, s, x);
        block.next()[s] = quad(x, density_of(model, block, s, block.position(), boundary).above);
    }
    __syncthreads();
}

/// Notes C_i of slot s if it began the substep overlapping; true if it did.
template <class Real, class Block>
__device__ bool note_overlap(const ModelView<Real>& model, Block& block, int s) {
    const physics::Boundary<Real> boundary = boundary_terms(model, block, s, xyz(block.position()[s]));
    const Real above = density_of(model, block, s, block.start(), boundary).above;
    const Real overlap = above > Real(physics::overlap_tolerance) ? above : Real(0);
    block.overlap()[s] = overlap;
    block.overlap_lambda()[s] = 0;
    return overlap > 0;
}

/// True if any particles began the substep overlapping. Ends with a barrier.
template <class Real, class Block>
__device__ bool find_overlap(const ModelView<Real>& model, Block& block) {
    bool any = false;
    for (int s = threadIdx.x; s < model.fluid; s += threads) any |= note_overlap(model, block, s);
    return __syncthreads_or(any);
}

/// sum_j (lambda_i + lambda_j) grad_i W_ij / rho0, where lambda_of(slot, its position) gives the lambdas.
template <class Real, class Block, class LambdaOf>
__device__ Vec3<Real> density_push(const ModelView<Real>& model, const Block& block, int s, const Quad<Real>* positions,
                                   const LambdaOf& lambda_of) {
    const Quad<Real> here = positions[s];
    const Real own = lambda_of(s, here);
    physics::PressurePush<Real> push;
    for_each_neighbour(model, block, s, [&](int other) {
        const Quad<Real> there = positions[other];
        const Vec3<Real> difference = xyz(here) - xyz(there);
        const physics::Distance<Real> distance = physics::distance_of(difference);
        push.add(difference, distance, 1 - distance.r * model.inverse_radius, own + lambda_of(other, there));
    });
    return model.fluid_kernel.gradient_scale * push.sum;
}

template <class Real>
__device__ Vec3<Real> solid_pressure_push(const ModelView<Real>& model, const Vec3<Real>& difference, Real lambda) {
    return physics::solid_pressure_push(difference, model.inverse_radius,
                                        model.solid_pressure * model.fluid_kernel.gradient_scale, lambda);
}

/// Moves the solids of a unit of touched slots by the fluid's pressure.
template <class Real, class Block>
__device__ void push_solids_by_pressure(const ModelView<Real>& model, Block& block, int unit) {
    work_on_touched(block, unit, [&](int s, int lane) {
        const bool solid = s >= model.fluid;
        Vec3<Real> push{0, 0, 0};
        if (solid) {
            const Vec3<Real> x = xyz(block.next()[s]);
            for_each_contact_of(model, block, s, lane, pair_lanes, [&](int other) {
                if (other >= model.fluid) return;
                const Quad<Real> there = block.next()[other];
                push = push + solid_pressure_push(model, x - xyz(there), there.w);
            });
        }
        push = {sum_of_lanes(push.x), sum_of_lanes(push.y), sum_of_lanes(push.z)};
        if (lane != 0 || !solid) return;  // one thread alone reads and writes the slot
        const Real inverse_mass = block.position()[s].w;
        if (inverse_mass > 0) move(block, s, model.relaxation_factor * Real(physics::pair_share) * inverse_mass * push);
    });
}

/// Moves fluid slot s by the density constraints.
template <class Real, class Block>
__device__ void push_fluid_by_pressure(const ModelView<Real>& model, Block& block, int s) {
    const Real inverse_mass = block.position()[s].w;
    if (!(inverse_mass > 0)) return;
    const Quad<Real> here = block.next()[s];
    Vec3<Real> push = density_push(model, block, s, block.next(), [](int, const Quad<Real>& there) { return there.w; });
    for_each_near_plane(model, block, s, xyz(here), [&](const physics::PlaneSurface<Real>& plane, Real distance) {
        push = push - here.w * plane_slope(model, distance) * plane.normal;
    });
    if (model.plan.solid_pressure)
        for_each_contact(model, block, s, [&](int other) {
            push = push + solid_pressure_push(model, xyz(here) - xyz(block.next()[other]), here.w);
        });
    move(block, s, model.relaxation_factor * Real(physics::pair_share) * inverse_mass * push);
}

/// Moves fluid and solids by the density constraints, where lambda is beside the positions in `next`.
template <class Real, class Block>
__device__ void push_by_pressure(const ModelView<Real>& model, Block& block) {
    const int touched = model.plan.solid_pressure ? touched_units<Real>(model, block) : 0;
    for_each_unit(block, touched + (model.fluid + 31) / 32, [&](int unit) {
        if (unit < touched) return push_solids_by_pressure(model, block, unit);
        const int s = (unit - touched) * 32 + threadIdx.x % 32;
        if (s < model.fluid) push_fluid_by_pressure(model, block, s);
    });
}

/// Ends with a barrier.
template <class Real, class Block>
__device__ void solve_density_constraint(const ModelView<Real>& model, Block& block, bool first) {
    const bool high = compute_lambda(model, block);
    if (first && high && find_overlap(model, block)) {
        block.overlapping = true;
        for (int s = threadIdx.x; s < model.fluid; s += threads) block.lambda_sum()[s] = 0;
        __syncthreads();
        compute_lambda(model, block);
    }
    push_by_pressure(model, block);
    __syncthreads();
}

/// lambda of the constraints on the density's rate.
template <class Real, class Block>
__device__ void compute_rate_lambda(const ModelView<Real>& model, Block& block) {
    for_each_unit(block, (model.fluid + 31) / 32, [&](int unit) {
        const int s = unit * 32 + threadIdx.x % 32;
        if (s >= model.fluid) return;
        const Vec3<Real> x = xyz(block.position()[s]);
        const Quad<Real> u = block.next()[s];
        physics::RateSums<Real> sums;
        for_each_neighbour(model, block, s, [&](int other) {
            const Quad<Real> moves = block.next()[other];
            const Vec3<Real> difference = x - xyz(block.position()[other]);
            const physics::Distance<Real> distance = physics::distance_of(difference);
            sums.add(difference, distance, 1 - distance.r * model.inverse_radius, moves.w, xyz(moves) - xyz(u));
        });
        const Quad<Real> boundary = block.boundary()[s];
        const Real scale = model.fluid_kernel.gradient_scale, sum = block.lambda_sum()[s];
        const Real response = sums.gradients.response(u.w, scale, xyz(boundary), boundary.w);
        const Real limited = sums.lambda(scale, response, -sum / block.h);
        block.lambda()[s] = limited;
        block.lambda_sum()[s] = sum + block.h * limited;
    });
}

template <class Real, class Block>
__device__ void push_by_rate_lambda(const ModelView<Real>& model, Block& block) {
    for_each_unit(block, (model.fluid + 31) / 32, [&](int unit) {
        const int s = unit * 32 + threadIdx.x % 32;
        if (s >= model.fluid) return;
        const Quad<Real> u = block.next()[s];
        const Vec3<Real> push = density_push(model, block, s, block.position(),
                                             [&](int slot, const Quad<Real>&) { return block.lambda()[slot]; });
        block.next()[s] = quad(xyz(u) + Real(physics::pair_share) * u.w * push, u.w);
    });
}

/// Takes the rate of change of the density to 0 where the fluid is under pressure.:
/// `next` holds velocities, with inverse masses, before and after. Ends with a barrier.
template <class Real, class Block>
__device__ void solve_density_rate(const ModelView<Real>& model, Block& block) {
    compute_rate_lambda(model, block);
    __syncthreads();
    push_by_rate_lambda(model, block);
    __syncthreads();
}

}  // namespace natator::cuda
