#pragma once

// The density constraint of scheme conserving. As cpu/conserving/density.cpp and density_kernels.cpp, which cite the
// papers.
#include "conserving_move.cuh"
#include "conserving_overlap.cuh"

namespace natator::cuda {

/// 1 - q for a particle at `distance` from a plane; between 0 and 1.
template <class Real>
__device__ Real plane_nearness(const ModelView<Real>& model, Real distance) {
    return min(max(1 - (distance + model.plane_gap) * model.inverse_radius, Real(0)), Real(1));
}

/// Minus the derivative of a plane's part of the density by the distance.
template <class Real>
__device__ Real plane_slope(const ModelView<Real>& model, Real distance) {
    const Real t = plane_nearness(model, distance);
    return model.plane_scale * model.inverse_radius * t * t * t * t * (Real(1) / 4 - t / 5);
}

/// Calls visit(plane, distance) for the planes near slot s, the last plane first.
template <class Real, class Block, class Visit>
__device__ void for_each_near_plane(const ModelView<Real>& model, const Block& block, int s, const Vec3<Real>& x,
                                    const Visit& visit) {
    const unsigned near = block.plane_contact()[s];
    if (near == 0) return;
    for (int k = model.planes - 1; k >= 0; --k)
        if (near >> k & 1) visit(model.plane[k], dot(model.plane[k].normal, x) + model.plane[k].offset);
}

/// What planes and solids add to C_i, to its gradient and to sum_k w_k |grad_k C_i|^2.
template <class Real>
struct Boundary {
    Real density = 0;
    Vec3<Real> gradient{0, 0, 0};
    Real square = 0;
};

template <class Real, class Block>
__device__ Boundary<Real> boundary_terms(const ModelView<Real>& model, const Block& block, int s, const Vec3<Real>& x) {
    Boundary<Real> boundary;
    for_each_near_plane(model, block, s, x, [&](const PlaneView<Real>& plane, Real distance) {
        const Real t = plane_nearness(model, distance);
        boundary.density += model.plane_scale * t * t * t * t * t * (Real(1) / 20 - t / 30);
        boundary.gradient = boundary.gradient - plane_slope(model, distance) * plane.normal;
    });
    if (!model.plan.solid_pressure) return boundary;
    Real sum = 0;
    for_each_contact(model, block, s, [&](int other) {
        const Vec3<Real> difference = x - xyz(block.position()[other]);
        const Real r = norm(difference);
        const Real q = r * model.inverse_radius;
        if (q >= 1) return;
        const Real slope = model.solid_pressure * model.gradient_scale * (1 - q) * (1 - q);
        sum += (1 - q) * (1 - q) * (1 - q);
        if (r > 0) boundary.gradient = boundary.gradient - slope / r * difference;
        boundary.square += block.position()[other].w * slope * slope;
    });
    boundary.density += model.solid_pressure * model.kernel_scale * sum;
    return boundary;
}

/// 1 / v, or 0 where v comes from neighbours that the kernel ends at alone and 1 / v may be infinite.
template <class Real>
__device__ Real finite_inverse(Real v) {
    return v > Real(1e-30f) ? 1 / v : Real(0);
}

/// C_i and 1 / (w_i |grad_i C_i|^2 + sum_k w_k |grad_k C_i|^2).
template <class Real>
struct Density {
    Real above, response;
};

/// Of slot s, with the fluid at `positions`.
template <class Real, class Block>
__device__ Density<Real> density_of(const ModelView<Real>& model, const Block& block, int s,
                                    const Quad<Real>* positions, const Boundary<Real>& boundary) {
    const Quad<Real> here = positions[s];
    const Vec3<Real> x = xyz(here);
    Real sum = 0, square = 0;
    Vec3<Real> gradient{0, 0, 0};
    for_each_neighbour(model, block, s, [&](int other) {
        const Quad<Real> there = positions[other];
        const auto [difference, r, inverse_r] = separation(x, xyz(there));
        const Real t = max(1 - r * model.inverse_radius, Real(0));
        const Real g = t * t;
        sum += g * t;
        gradient = gradient - g * inverse_r * difference;
        square += there.w * g * g;
    });
    const Vec3<Real> c = model.gradient_scale * gradient + boundary.gradient;
    const Real others = model.gradient_scale * model.gradient_scale * square + boundary.square;
    return {model.kernel_scale * (sum - model.rest_sum) + boundary.density,
            finite_inverse(here.w * dot(c, c) + others)};
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
            const Boundary<Real> boundary = boundary_terms(model, block, s, x);
            block.boundary()[s] = quad(boundary.gradient, boundary.square);
            const Density<Real> density = density_of(model, block, s, block.position(), boundary);
            if (block.overlapping)
                lambda = limited_lambda(model, block, s, density.above, density.response);
            else if (density.above > 0)
                lambda = -density.above * density.response;
            high |= density.above > cpu::overlap_tolerance<Real>;
            block.lambda_sum()[s] += lambda;
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
        const Boundary<Real> boundary = boundary_terms(model, block, s, x);
        block.next()[s] = quad(x, density_of(model, block, s, block.position(), boundary).above);
    }
    __syncthreads();
}

/// Notes C_i of slot s if it began the substep overlapping; true if it did.
template <class Real, class Block>
__device__ bool note_overlap(const ModelView<Real>& model, Block& block, int s) {
    const Boundary<Real> boundary = boundary_terms(model, block, s, xyz(block.position()[s]));
    const Real above = density_of(model, block, s, block.start(), boundary).above;
    const Real overlap = above > cpu::overlap_tolerance<Real> ? above : Real(0);
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
    Vec3<Real> sum{0, 0, 0};
    for_each_neighbour(model, block, s, [&](int other) {
        const Quad<Real> there = positions[other];
        const auto [difference, r, inverse_r] = separation(xyz(here), xyz(there));
        const Real t = max(1 - r * model.inverse_radius, Real(0));
        sum = sum - (own + lambda_of(other, there)) * t * t * inverse_r * difference;
    });
    return model.gradient_scale * sum;
}

/// -lambda |grad C| n for the contact of a fluid particle and a solid: what it pushes the one at `difference` from the
/// other by.
template <class Real>
__device__ Vec3<Real> solid_pressure_push(const ModelView<Real>& model, const Vec3<Real>& difference, Real lambda) {
    const Real r = norm(difference);
    const Real q = r * model.inverse_radius;
    if (q >= 1 || !(r > 0)) return {0, 0, 0};
    const Real slope = model.solid_pressure * model.gradient_scale * (1 - q) * (1 - q);
    return -lambda * slope / r * difference;
}

constexpr float pair_share = 0.5f;  ///< of each of a pair's two constraints, see conserving_stages.h

/// Moves the solids of a unit of touched slots by the fluid's pressure. As cpu/conserving/density.cpp.
template <class Real, class Block>
__device__ void push_solids_by_pressure(const ModelView<Real>& model, Block& block, int unit) {
    work_on_touched(block, unit, [&](int s, int lane) {
        const bool solid = s >= model.fluid;
        Vec3<Real> push{0, 0, 0};
        if (solid) {
            const Vec3<Real> x = xyz(block.next()[s]);
            for_each_contact_of(model, block, s, lane, contact_lanes, [&](int other) {
                if (other >= model.fluid) return;
                const Quad<Real> there = block.next()[other];
                push = push + solid_pressure_push(model, x - xyz(there), there.w);
            });
        }
        push = {sum_of_lanes(push.x), sum_of_lanes(push.y), sum_of_lanes(push.z)};
        if (lane != 0 || !solid) return;  // one thread alone reads and writes the slot
        const Real inverse_mass = block.position()[s].w;
        if (inverse_mass > 0) move(block, s, model.relaxation_factor * Real(pair_share) * inverse_mass * push);
    });
}

/// Moves fluid slot s by the density constraints.
template <class Real, class Block>
__device__ void push_fluid_by_pressure(const ModelView<Real>& model, Block& block, int s) {
    const Real inverse_mass = block.position()[s].w;
    if (!(inverse_mass > 0)) return;
    const Quad<Real> here = block.next()[s];
    Vec3<Real> push = density_push(model, block, s, block.next(), [](int, const Quad<Real>& there) { return there.w; });
    for_each_near_plane(model, block, s, xyz(here), [&](const PlaneView<Real>& plane, Real distance) {
        push = push - here.w * plane_slope(model, distance) * plane.normal;
    });
    if (model.plan.solid_pressure)
        for_each_contact(model, block, s, [&](int other) {
            push = push + solid_pressure_push(model, xyz(here) - xyz(block.next()[other]), here.w);
        });
    move(block, s, model.relaxation_factor * Real(pair_share) * inverse_mass * push);
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

/// As cpu/conserving/density.cpp. Ends with a barrier.
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
        Real rate = 0, square = 0;
        Vec3<Real> gradient{0, 0, 0};
        for_each_neighbour(model, block, s, [&](int other) {
            const Quad<Real> moves = block.next()[other];
            const auto [difference, r, inverse_r] = separation(x, xyz(block.position()[other]));
            const Real t = max(1 - r * model.inverse_radius, Real(0));
            const Real g = t * t, slope = g * inverse_r;
            rate += slope * dot(xyz(moves) - xyz(u), difference);
            gradient = gradient - slope * difference;
            square += moves.w * g * g;
        });
        const Quad<Real> boundary = block.boundary()[s];
        const Vec3<Real> c = model.gradient_scale * gradient + xyz(boundary);
        const Real others = model.gradient_scale * model.gradient_scale * square + boundary.w;
        const Real lambda = -model.gradient_scale * rate * finite_inverse(u.w * dot(c, c) + others);
        const Real sum = block.lambda_sum()[s], most = -sum / block.h;
        const Real limited = most > 0 ? min(lambda, most) : Real(0);
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
        block.next()[s] = quad(xyz(u) + Real(pair_share) * u.w * push, u.w);
    });
}

/// Takes the rate of change of the density to 0 where the fluid is under pressure. As cpu/conserving/velocities.cpp:
/// `next` holds velocities, with inverse masses, before and after. Ends with a barrier.
template <class Real, class Block>
__device__ void solve_density_rate(const ModelView<Real>& model, Block& block) {
    compute_rate_lambda(model, block);
    __syncthreads();
    push_by_rate_lambda(model, block);
    __syncthreads();
}

}  // namespace natator::cuda
