#pragma once

#include "block.cuh"

namespace natator::cuda {

/// Mean x of the body's particles, summed by one warp in a fixed order. Ends with a barrier.
template <class Real, class Block>
__device__ void measure_path(const ModelView<Real>& model, const Block& block, double* mean_x) {
    if (threadIdx.x < 32) {
        double sum = 0;
        for (int b = threadIdx.x; b < model.body; b += 32)
            sum += block.position()[block.slot_of_solid()[model.body_particle[b]]].x;
        for (int step = 16; step > 0; step /= 2) sum += __shfl_xor_sync(0xffffffff, sum, step);
        if (threadIdx.x == 0) *mean_x = model.body > 0 ? sum / model.body : 0;
    }
    __syncthreads();
}

/// Does a particle of the body touch a plane? As measure/measure.cpp.
template <class Real, class Block>
__device__ bool touches_plane(const ModelView<Real>& model, const Block& block) {
    bool touches = false;
    for (int b = threadIdx.x; b < model.body; b += threads) {
        const Quad<Real> x = block.position()[block.slot_of_solid()[model.body_particle[b]]];
        for (int k = 0; k < model.planes; ++k) {
            const PlaneView<Real>& plane = model.plane[k];
            const double distance =
                plane.normal_d[0] * x.x + plane.normal_d[1] * x.y + plane.normal_d[2] * x.z + plane.offset_d;
            touches |= distance <= double(model.collision_distance) + 1e-6 * (fabs(plane.offset_d) + 1);
        }
    }
    return __syncthreads_or(touches);
}

}  // namespace natator::cuda
