#pragma once

// The density constraint of scheme conserving. As cpu/conserving/density.cpp and density_kernels.cpp, which cite the
// papers.
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
template <class Real, class Visit>
__device__ void for_each_near_plane(const ModelView<Real>& model, const Block<Real>& block, int s, const Vec3<Real>& x,
                                    const Visit& visit) {
    const unsigned near = block.plane_contact[s];
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

template <class Real>
__device__ Boundary<Real> boundary_terms(const ModelView<Real>& model, const Block<Real>& block, int s,
                                         const Vec3<Real>& x) {
    Boundary<Real> boundary;
    for_each_near_plane(model, block, s, x, [&](const PlaneView<Real>& plane, Real distance) {
        const Real t = plane_nearness(model, distance);
        boundary.density += model.plane_scale * t * t * t * t * t * (Real(1) / 20 - t / 30);
        boundary.gradient = boundary.gradient - plane_slope(model, distance) * plane.normal;
    });
    if (!model.plan.solid_pressure) return boundary;
    Real sum = 0;
    for_each_contact(model, block, s, [&](int other) {
        const Vec3<Real> difference = x - xyz(block.position[other]);
        const Real r = norm(difference);
        const Real q = r * model.inverse_radius;
        if (q >= 1) return;
        const Real slope = model.solid_pressure * model.gradient_scale * (1 - q) * (1 - q);
        sum += (1 - q) * (1 - q) * (1 - q);
        if (r > 0) boundary.gradient = boundary.gradient - slope / r * difference;
        boundary.square += block.drift[other].w * slope * slope;
    });
    boundary.density += model.solid_pressure * model.kernel_scale * sum;
    return boundary;
}

/// Inverse mass of the fluid particle in a slot.
template <class Real>
__device__ Real fluid_inverse_mass(const ModelView<Real>& model, const Quad<Real>& position) {
    return model.fluid_inverse_mass >= 0 ? model.fluid_inverse_mass : model.inverse_mass[number_in(position.w)];
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
template <class Real>
__device__ Density<Real> density_of(const ModelView<Real>& model, const Block<Real>& block, int s,
                                    const Quad<Real>* positions, const Boundary<Real>& boundary) {
    const Quad<Real> here = positions[s];
    const Vec3<Real> x = xyz(here);
    Real sum = 0, square = 0;
    Vec3<Real> gradient{0, 0, 0};
    const std::uint16_t* const list = block.neighbour + s;
    const int count = block.neighbour_count[s];
    for (int k = 0; k < count; ++k) {
        const Quad<Real> there = positions[list[k * static_cast<std::size_t>(model.fluid)]];
        const Vec3<Real> difference = x - xyz(there);
        const Real r2 = dot(difference, difference);
        const Real inverse_r = inverse_root<Real>(r2 + tiny<Real>());
        const Real t = max(1 - r2 * inverse_r * model.inverse_radius, Real(0));
        const Real g = t * t;
        sum += g * t;
        gradient = gradient - g * inverse_r * difference;
        square += fluid_inverse_mass(model, there) * g * g;
    }
    const Vec3<Real> c = model.gradient_scale * gradient + boundary.gradient;
    const Real others = model.gradient_scale * model.gradient_scale * square + boundary.square;
    return {model.kernel_scale * (sum - model.rest_sum) + boundary.density,
            finite_inverse(block.drift[s].w * dot(c, c) + others)};
}

/// lambda of all fluid slots at the present positions; true if any is an overlap. Ends with a barrier.
template <class Real>
__device__ bool compute_lambda(const ModelView<Real>& model, Block<Real>& block) {
    bool high = false;
    for (int s = threadIdx.x; s < model.fluid; s += threads) {
        const Boundary<Real> boundary = boundary_terms(model, block, s, xyz(block.position[s]));
        block.boundary[s] = quad(boundary.gradient, boundary.square);
        const Density<Real> density = density_of(model, block, s, block.position, boundary);
        const Real lambda = block.overlapping   ? limited_lambda(model, block, s, density.above, density.response)
                            : density.above > 0 ? -density.above * density.response
                                                : Real(0);
        high |= density.above > cpu::overlap_tolerance<Real>;
        block.compression[s] = lambda;
        block.lambda_sum[s] += lambda;
    }
    return __syncthreads_or(high);
}

/// C_i of all fluid slots at the present positions, in place of lambda. Ends with a barrier.
template <class Real>
__device__ void compute_density_above_rest(const ModelView<Real>& model, Block<Real>& block) {
    for (int s = threadIdx.x; s < model.fluid; s += threads) {
        const Boundary<Real> boundary = boundary_terms(model, block, s, xyz(block.position[s]));
        block.compression[s] = density_of(model, block, s, block.position, boundary).above;
    }
    __syncthreads();
}

/// Notes C_i of the particles that began the substep overlapping; true if there are any. Ends with a barrier.
template <class Real>
__device__ bool find_overlap(const ModelView<Real>& model, Block<Real>& block) {
    bool any = false;
    for (int s = threadIdx.x; s < model.fluid; s += threads) {
        const Boundary<Real> boundary = boundary_terms(model, block, s, xyz(block.position[s]));
        const Real above = density_of(model, block, s, block.start, boundary).above;
        block.overlap[s] = above > cpu::overlap_tolerance<Real> ? above : Real(0);
        block.overlap_lambda[s] = block.lambda_sum[s] = 0;
        any |= block.overlap[s] > 0;
    }
    return __syncthreads_or(any);
}

/// sum_j (lambda_i + lambda_j) grad_i W_ij / rho0.
template <class Real>
__device__ Vec3<Real> density_push(const ModelView<Real>& model, const Block<Real>& block, int s, const Vec3<Real>& x) {
    const Real own = block.compression[s];
    const std::uint16_t* const list = block.neighbour + s;
    const int count = block.neighbour_count[s];
    Vec3<Real> sum{0, 0, 0};
    for (int k = 0; k < count; ++k) {
        const int other = list[k * static_cast<std::size_t>(model.fluid)];
        const Vec3<Real> difference = x - xyz(block.position[other]);
        const Real r2 = dot(difference, difference);
        const Real inverse_r = inverse_root<Real>(r2 + tiny<Real>());
        const Real t = max(1 - r2 * inverse_r * model.inverse_radius, Real(0));
        sum = sum - (own + block.compression[other]) * t * t * inverse_r * difference;
    }
    return model.gradient_scale * sum;
}

/// sum over the fluid's contacts of slot s with solids, or a solid's with fluid, of -lambda |grad C| n.
template <class Real>
__device__ Vec3<Real> solid_pressure_push(const ModelView<Real>& model, const Block<Real>& block, int s,
                                          const Vec3<Real>& x) {
    Vec3<Real> sum{0, 0, 0};
    for_each_contact(model, block, s, [&](int other) {
        if (s >= model.fluid && other >= model.fluid) return;
        const Vec3<Real> difference = x - xyz(block.position[other]);
        const Real r = norm(difference);
        const Real q = r * model.inverse_radius;
        if (q >= 1 || !(r > 0)) return;
        const Real slope = model.solid_pressure * model.gradient_scale * (1 - q) * (1 - q);
        const Real lambda = block.compression[s < model.fluid ? s : other];
        sum = sum - lambda * slope / r * difference;
    });
    return sum;
}

/// As cpu/conserving/density.cpp. Ends with a barrier.
template <class Real>
__device__ void solve_density_constraint(const ModelView<Real>& model, Block<Real>& block, bool first) {
    const bool high = compute_lambda(model, block);
    if (first && high) {
        if (find_overlap(model, block)) {
            block.overlapping = true;
            compute_lambda(model, block);
        } else {
            for (int s = threadIdx.x; s < model.fluid; s += threads) block.lambda_sum[s] = block.compression[s];
        }
    }
    constexpr Real pair_share = Real(0.5);  // of each of a pair's two constraints, see conserving_stages.h
    const Real scale = model.relaxation_factor * pair_share;
    for (int s = threadIdx.x; s < model.particles; s += threads) {
        const Quad<Real> here = block.position[s];
        const Vec3<Real> x = xyz(here);
        const Real inverse_mass = block.drift[s].w;
        const bool moves = inverse_mass > 0 && (s < model.fluid || model.plan.solid_pressure);
        Quad<Real> to = here;
        if (moves) {
            Vec3<Real> push{0, 0, 0};
            if (s < model.fluid) {
                push = density_push(model, block, s, x);
                const Real lambda = block.compression[s];
                for_each_near_plane(model, block, s, x, [&](const PlaneView<Real>& plane, Real distance) {
                    push = push - lambda * plane_slope(model, distance) * plane.normal;
                });
            }
            if (model.plan.solid_pressure) push = push + solid_pressure_push(model, block, s, x);
            const Vec3<Real> displacement = xyz(block.displacement[s]) + scale * inverse_mass * push;
            block.displacement[s] = quad(displacement, Real(0));
            to = quad(xyz(block.base[s]) + displacement, here.w);
        }
        block.next[s] = to;
    }
    __syncthreads();
    Quad<Real>* const swap = block.position;
    block.position = block.next;
    block.next = swap;
}

/// Takes the rate of change of the density to 0 where the fluid is under pressure. As cpu/conserving/velocities.cpp:
/// `next` holds velocities, with inverse masses, before and after. Ends with a barrier.
template <class Real>
__device__ void solve_density_rate(const ModelView<Real>& model, Block<Real>& block) {
    for (int s = threadIdx.x; s < model.fluid; s += threads) {
        const Vec3<Real> x = xyz(block.position[s]);
        const Quad<Real> u = block.next[s];
        Real rate = 0, square = 0;
        Vec3<Real> gradient{0, 0, 0};
        const std::uint16_t* const list = block.neighbour + s;
        const int count = block.neighbour_count[s];
        for (int k = 0; k < count; ++k) {
            const int other = list[k * static_cast<std::size_t>(model.fluid)];
            const Quad<Real> moves = block.next[other];
            const Vec3<Real> difference = x - xyz(block.position[other]);
            const Real r2 = dot(difference, difference);
            const Real inverse_r = inverse_root<Real>(r2 + tiny<Real>());
            const Real t = max(1 - r2 * inverse_r * model.inverse_radius, Real(0));
            const Real g = t * t, slope = g * inverse_r;
            rate += slope * dot(xyz(moves) - xyz(u), difference);
            gradient = gradient - slope * difference;
            square += moves.w * g * g;
        }
        const Quad<Real> boundary = block.boundary[s];
        const Vec3<Real> c = model.gradient_scale * gradient + xyz(boundary);
        const Real others = model.gradient_scale * model.gradient_scale * square + boundary.w;
        const Real lambda = -model.gradient_scale * rate * finite_inverse(u.w * dot(c, c) + others);
        const Real most = -block.lambda_sum[s] / block.h;
        const Real limited = most > 0 ? min(lambda, most) : Real(0);
        block.compression[s] = limited;
        block.lambda_sum[s] += block.h * limited;
    }
    __syncthreads();
    for (int s = threadIdx.x; s < model.fluid; s += threads) {
        const Quad<Real> u = block.next[s];
        const Vec3<Real> push = density_push(model, block, s, xyz(block.position[s]));
        block.next[s] = quad(xyz(u) + Real(0.5) * u.w * push, u.w);
    }
    __syncthreads();
}

}  // namespace natator::cuda
