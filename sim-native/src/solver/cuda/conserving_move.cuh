#pragma once

#include "contacts.cuh"

namespace natator::cuda {

/// Moves a slot: the displacement is kept apart from the place it started at, so that it is not rounded to it.
template <class Real, class Block>
__device__ void move(Block& block, int s, const Vec3<Real>& by) {
    const Vec3<Real> displacement = xyz(block.displacement()[s]) + by;
    block.displacement()[s] = quad(displacement, Real(0));
    const Quad<Real> base = block.base()[s];
    block.position()[s] = quad(xyz(base) + displacement, base.w);
}

}  // namespace natator::cuda
