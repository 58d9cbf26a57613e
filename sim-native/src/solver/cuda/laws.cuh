#pragma once

#include "physics/laws.h"
#include "state_team.cuh"

namespace natator::cuda {

/// Measures of one particle for the laws of physics/laws.h.
template <class Real>
__device__ physics::LawMeasures measures_of(const ModelView<Real>& model, int number, const Vec4<Real>& x,
                                            const Vec3<Real>& v) {
    physics::LawMeasures measures;
    if (!(x.w > 0)) return measures;
    const Vec3<Real>& gravity = number < model.fluid ? model.bounded_fluid_gravity : model.bounded_gravity;
    measures.particle_energy = physics::particle_energy(v, xyz(x), gravity);
    measures.most_energetic = measures.deepest = number;
    if (model.scheme == Scheme::conserving) measures.energy = measures.particle_energy / x.w;
    measures.depth = -1;
    for (int k = 0; k < model.planes; ++k)
        measures.depth = max(measures.depth, -distance_to(model.plane[k].exact, physics::cast<double>(xyz(x))));
    return measures;
}

/// Distance of a particle of the body from the body's first one.
template <class Real, class Team>
__device__ physics::LawMeasures reach_of(const ModelView<Real>& model, const Team& team, int b) {
    const auto place = [&](int k) { return xyz(team.position()[team.slot_of_solid()[model.body_particle[k]]]); };
    physics::LawMeasures measures;
    measures.reach_square = physics::squared_length(place(b) - place(0));
    measures.farthest = model.fluid + model.body_particle[b];
    return measures;
}

}  // namespace natator::cuda
