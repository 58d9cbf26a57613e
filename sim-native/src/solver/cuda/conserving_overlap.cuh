#pragma once

// Starts that overlap, see cpu/conserving/overlap.cpp.
#include "contacts.cuh"
#include "physics/pbf_density.h"

namespace natator::cuda {

/// Puts what starts behind a plane, or nearer to one than `distance`, there: see physics::put_before.
template <class Real>
__device__ Vec3<Real> put_before_planes(const ModelView<Real>& model, Vec3<Real> x, Real distance) {
    for (int k = 0; k < model.planes; ++k) x = put_before(model.plane[k].surface, distance, x);
    return x;
}

/// Depth of a contact beyond what this substep may leave of it.
template <class Real, class Block>
__device__ Real contact_depth(const ModelView<Real>& model, const Block& block, int s, int other) {
    const auto distance = [&](const Quad<Real>* places) { return norm(xyz(places[s]) - xyz(places[other])); };
    return physics::limited_depth(
        model.solid_rest_distance, distance(block.position()), model.overlap_acceleration * block.h * block.h,
        [&] { return distance(block.start()); }, [&] { return distance(block.base()); });
}

/// lambda_i of a slot where some particles began the substep overlapping.
template <class Real, class Block>
__device__ Real limited_lambda(const ModelView<Real>& model, Block& block, int s, Real above, Real response) {
    return physics::limited_lambda(above, response, block.overlap()[s],
                                   model.overlap_acceleration * block.h * block.h, block.position()[s].w,
                                   model.fluid_kernel.gradient_scale, block.overlap_lambda()[s]);
}

/// Keeps a pair of fluid particles only if both keep it, where lists are full. Ends with a barrier if it does anything.
/// An entry that is dropped is none that another particle looks for: it looks for itself in the lists of its own.
template <class Real, class Block>
__device__ void keep_mutual_neighbours(const ModelView<Real>& model, Block& block) {
    constexpr std::uint16_t dropped = 0xffff;
    const auto entry = [&](int s, int k) -> volatile std::uint16_t& {
        return reinterpret_cast<std::uint16_t*>(block.neighbour() + static_cast<std::size_t>(k / 8) * model.fluid +
                                                s)[k % 8];
    };
    bool full = false;
    for (int s = threadIdx.x; s < model.fluid; s += threads)
        full |= block.neighbour_count()[s] == model.most_neighbours;
    if (!__syncthreads_or(full)) return;
    for (int s = threadIdx.x; s < model.fluid; s += threads)
        for (int k = 0; k < block.neighbour_count()[s]; ++k) {
            const int other = entry(s, k);
            if (block.neighbour_count()[other] != model.most_neighbours) continue;
            bool mutual = false;
            for (int e = 0; e < model.most_neighbours && !mutual; ++e) mutual = entry(other, e) == s;
            if (!mutual) entry(s, k) = dropped;
        }
    __syncthreads();
    for (int s = threadIdx.x; s < model.fluid; s += threads) {
        const int count = block.neighbour_count()[s];
        int kept = 0;
        for (int k = 0; k < count; ++k) {
            const std::uint16_t other = entry(s, k);
            if (other != dropped) entry(s, kept++) = other;
        }
        block.neighbour_count()[s] = static_cast<std::uint16_t>(kept);
        for (; kept % 8 != 0; ++kept) entry(s, kept) = static_cast<std::uint16_t>(model.particles);
    }
    __syncthreads();
}

}  // namespace natator::cuda
