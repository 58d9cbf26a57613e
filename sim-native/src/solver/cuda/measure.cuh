#pragma once

#include "block.cuh"
#include "physics/early_stop.h"

namespace natator::cuda {

/// Mean x of the body's particles, summed by one warp in a fixed order. Ends with a barrier.
template <class Real, class Block>
__device__ void measure_path(const ModelView<Real>& model, const Block& block, double* mean_x) {
    if (const int lane = block.thread(); lane < 32) {
        double sum = 0;
        for (int b = lane; b < model.body; b += 32)
            sum += block.position()[block.slot_of_solid()[model.body_particle[b]]].x;
        for (int step = 16; step > 0; step /= 2) sum += __shfl_xor_sync(0xffffffff, sum, step);
        if (lane == 0) *mean_x = model.body > 0 ? sum / model.body : 0;
    }
    block.barrier();
}

/// Mean z of the body's last slice. Ends with a barrier.
template <class Real, class Block>
__device__ void measure_tail(const ModelView<Real>& model, const Block& block, double* tail_z) {
    if (const int lane = block.thread(); lane < 32) {
        double sum = 0;
        for (int b = model.body - model.tail + lane; b < model.body; b += 32)
            sum += block.position()[block.slot_of_solid()[model.body_particle[b]]].z;
        for (int step = 16; step > 0; step /= 2) sum += __shfl_xor_sync(0xffffffff, sum, step);
        if (lane == 0) *tail_z = model.tail > 0 ? sum / model.tail : 0;
    }
    block.barrier();
}

/// Does a particle of the body touch a plane?
template <class Real, class Block>
__device__ bool touches_plane(const ModelView<Real>& model, const Block& block) {
    bool touches = false;
    for (int b = block.thread(); b < model.body; b += block.size()) {
        const Quad<Real> x = block.position()[block.slot_of_solid()[model.body_particle[b]]];
        for (int k = 0; k < model.planes; ++k) {
            const physics::PlaneSurface<double>& plane = model.plane[k].exact;
            touches |= physics::touches(distance_to(plane, physics::cast<double>(xyz(x))),
                                        double(model.collision_distance), plane.offset);
        }
    }
    return block.any(touches);
}

}  // namespace natator::cuda
