#pragma once

// Forces and losses that the thesis leaves off, where the GPU has them. As cpu/effects and cpu/flex/cohesion.cpp.
#include "contacts.cuh"

namespace natator::cuda {

/// Speed that planes give back to what comes in: restitution.
template <class Real, class Block>
__device__ Vec3<Real> rebound(const ModelView<Real>& model, const Block& block, int s, const Vec3<Real>& x,
                              const Vec3<Real>& predicted, Vec3<Real> v) {
    for_each_near_plane(model, block, s, x, [&](const physics::PlaneSurface<Real>& plane, Real distance) {
        if (distance > model.touching_distance) return;
        const Real missing =
            rebound_speed(plane.normal, predicted, v, model.restitution, block.h * model.slowest_impact);
        if (missing > 0) v += missing * plane.normal;
    });
    return v;
}

/// Number of contacts of slot s that would overlap without the solver.
template <class Real, class Block>
__device__ int overlaps_of(const ModelView<Real>& model, const Block& block, int s) {
    int count = 0;
    for_each_contact(model, block, s, [&](int other) {
        count += norm(xyz(block.position()[s]) - xyz(block.position()[other])) < model.solid_rest_distance;
    });
    return count;
}

/// Counts them for each slot. Ends with a barrier.
template <class Real, class Block>
__device__ void count_overlaps(const ModelView<Real>& model, Block& block) {
    for (int s = threadIdx.x; s < model.particles; s += threads)
        block.active()[s] = static_cast<std::uint16_t>(overlaps_of(model, block, s));
    __syncthreads();
}

/// Part of its velocity that a particle in contacts keeps in scheme flex: dissipation.
template <class Real, class Block>
__device__ Real kept_by_dissipation(const ModelView<Real>& model, const Block& block, int s) {
    const Real counted = max(static_cast<Real>(block.active()[s]) - 1, Real(0));
    const Real step = block.h * model.dissipation * counted;
    return 1 - step / (1 + step);
}

/// Pull of the fluid around a slot of `next` in scheme flex, per inverse mass: cohesion.
template <class Real, class Block>
__device__ Vec3<Real> cohesion_push(const ModelView<Real>& model, const Block& block, int s, const Vec3<Real>& x) {
    Vec3<Real> sum{0, 0, 0};
    for_each_neighbour(model, block, s, [&](int other) {
        const Vec3<Real> difference = x - xyz(block.next()[other]);
        const Real r = norm(difference);
        if (!(r > 0 && r < model.radius)) return;
        const Real q = r * model.inverse_radius, b = model.cohesion_slope;
        sum = sum + (q * q * (b - (b - 1) * q) - 1) / r * difference;
    });
    return -model.cohesion_strength * sum;
}

}  // namespace natator::cuda
