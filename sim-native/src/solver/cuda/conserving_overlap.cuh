#pragma once

// Starts that overlap, see cpu/conserving/overlap.cpp.
#include "contacts.cuh"
#include "solver/cpu/conserving/constants.h"

namespace natator::cuda {

/// Puts what starts behind a plane on it. As cpu/conserving/overlap.cpp.
template <class Real>
__device__ Vec3<Real> put_before_planes(const ModelView<Real>& model, Vec3<Real> x) {
    for (int k = 0; k < model.planes; ++k) {
        const PlaneView<Real>& plane = model.plane[k];
        const Real distance = dot(plane.normal, x) + (plane.offset - model.collision_distance);
        if (distance < -cpu::overlap_tolerance<Real> * model.collision_distance) x = x - distance * plane.normal;
    }
    return x;
}

/// Depth of a contact beyond what this substep may leave of it.
template <class Real, class Block>
__device__ Real contact_depth(const ModelView<Real>& model, const Block& block, int s, int other) {
    const Real rest = model.solid_rest_distance;
    const Real depth = rest - norm(xyz(block.position()[s]) - xyz(block.position()[other]));
    const Real push = model.overlap_acceleration * block.h * block.h;
    if (!(depth > push)) return depth;
    const Real at_start = rest - norm(xyz(block.start()[s]) - xyz(block.start()[other]));
    if (!(at_start > push)) return depth;
    const Real predicted = rest - norm(xyz(block.base()[s]) - xyz(block.base()[other]));
    return depth - max(min(at_start, predicted) - push, Real(0));
}

/// Limits what takes C_i = `above` from its value at the start to 0; what takes it back there acts in full. Returns
/// lambda_i.
template <class Real, class Block>
__device__ Real limited_lambda(const ModelView<Real>& model, Block& block, int s, Real above, Real response) {
    const Real at_start = block.overlap()[s], inverse_mass = block.position()[s].w;
    above = max(above, Real(0));
    if (!(at_start > 0) || !(inverse_mass > 0)) return -above * response;
    const Real push = model.overlap_acceleration * block.h * block.h;
    const Real most = push / (inverse_mass * model.gradient_scale * cbrt(1 + at_start));
    const Real wanted = min(above, at_start) * response;
    const Real given = min(wanted, max(most - block.overlap_lambda()[s], Real(0)));
    block.overlap_lambda()[s] += given;
    return -(max(above - at_start, Real(0)) * response + given);
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
