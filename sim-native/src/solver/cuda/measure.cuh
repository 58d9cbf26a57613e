#pragma once

#include "physics/early_stop.h"
#include "state_team.cuh"

namespace natator::cuda {

/// Mean x of the body's particles, summed by the team's first warp in a fixed order, whose first thread writes it.
template <class Real, class Team>
__device__ void measure_path(const ModelView<Real>& model, const Team& team, double* mean_x) {
    if (const int lane = team.thread(); lane < 32) {
        double sum = 0;
        for (int b = lane; b < model.body; b += 32)
            sum += team.position()[team.slot_of_solid()[model.body_particle[b]]].x;
        sum = sum_of_warp(sum);
        if (lane == 0) *mean_x = model.body > 0 ? sum / model.body : 0;
    }
}

/// Mean z of the body's last slice. Ends with a barrier.
template <class Real, class Team>
__device__ void measure_tail(const ModelView<Real>& model, const Team& team, double* tail_z) {
    if (const int lane = team.thread(); lane < 32) {
        double sum = 0;
        for (int b = model.body - model.tail + lane; b < model.body; b += 32)
            sum += team.position()[team.slot_of_solid()[model.body_particle[b]]].z;
        sum = sum_of_warp(sum);
        if (lane == 0) *tail_z = model.tail > 0 ? sum / model.tail : 0;
    }
    team.barrier();
}

/// Does a particle of the body touch a plane?
template <class Real, class Team>
__device__ bool touches_plane(const ModelView<Real>& model, const Team& team) {
    bool touches = false;
    for (int b = team.thread(); b < model.body; b += team.size()) {
        const Vec4<Real> x = team.position()[team.slot_of_solid()[model.body_particle[b]]];
        for (int k = 0; k < model.planes; ++k) {
            const physics::PlaneSurface<double>& plane = model.plane[k].exact;
            touches |= physics::touches(distance_to(plane, physics::cast<double>(xyz(x))),
                                        double(model.collision_distance), plane.offset);
        }
    }
    return team.any(touches);
}

}  // namespace natator::cuda
