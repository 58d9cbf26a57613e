#pragma once

// Ghosts of the water: copies of particles behind walls and the ends of periodic axes.
#include "physics/symmetric3.h"
#include "solver/solids/cuda/solids.cuh"

namespace natator::cuda {

/// H v.
template <class Real>
__device__ Vec3<Real> reflected(const GhostTransform<Real>& transform, const Vec3<Real>& v) {
    return {dot(xyz(transform.row[0]), v), dot(xyz(transform.row[1]), v), dot(xyz(transform.row[2]), v)};
}
/// H L H^T.
template <class Real>
__device__ physics::Symmetric3<Real> reflected(const GhostTransform<Real>& transform,
                                               const physics::Symmetric3<Real>& l) {
    const Vec3<Real> a = xyz(transform.row[0]), b = xyz(transform.row[1]), c = xyz(transform.row[2]);
    const Vec3<Real> x = l * a, y = l * b, z = l * c;
    return {dot(a, x), dot(b, y), dot(c, z), dot(a, y), dot(a, z), dot(b, z)};
}
template <class Real>
__device__ Vec3<Real> ghost_position(const WaterModel<Real>& water, const Vec3<Real>& x, unsigned boundaries) {
    if (boundaries == 0) return x;
    const GhostTransform<Real> transform = water.ghost_transform[boundaries];
    return reflected(transform, x) + Vec3<Real>{transform.row[0].w, transform.row[1].w, transform.row[2].w};
}

/// Distance that a particle keeps from planes. Water does not touch them otherwise: its ghosts hold it.
template <class Real>
__device__ Real wall_distance(const ModelView<Real>& model, bool fluid) {
    return fluid ? Real(physics::min_wall_distance) * model.water.spacing : model.collision_distance;
}

/// Calls visit(boundaries, position) for the ghosts of what is at x, itself a ghost of `boundaries` or none, in up to
/// `max_more` more boundaries from number `first` on: in those that it is before, nearer than the kernel's support.
template <int max_more, class Real, class Visit>
__device__ void for_each_ghost(const ModelView<Real>& model, const Vec3<Real>& x, const Vec3<Real>& of,
                               unsigned boundaries, int first, const Visit& visit) {
    for (int k = first; k < model.water.boundaries; ++k) {
        const Real distance = distance_to(model.water.boundary[k].surface, x);
        if (!(distance >= 0 && distance < model.water.radius)) continue;
        const unsigned with_this = boundaries | 1u << k;
        const Vec3<Real> ghost = ghost_position(model.water, of, with_this);
        visit(with_this, ghost);
        if constexpr (max_more > 1) for_each_ghost<max_more - 1>(model, ghost, of, with_this, k + 1, visit);
    }
}

/// Calls visit(boundaries, position) for a particle at x, with boundaries = 0, and for its ghosts.
template <class Real, class Visit>
__device__ void for_each_copy(const ModelView<Real>& model, const Vec3<Real>& x, const Visit& visit) {
    visit(0u, x);
    for_each_ghost<physics::max_boundaries_of_ghost>(model, x, x, 0, 0, visit);
}

/// The place of x as the water has it: in a periodic tank within its ends.
template <class Real>
__device__ Vec3<Real> place_in_tank(const WaterModel<Real>& water, Vec3<Real> x) {
    for (int k = 0; k < water.periodic_axes; ++k) x = to_tank(water.periodic_axis[k], x);
    return x;
}
template <class Real>
__device__ Vec3<Real> wrapped_water(const WaterModel<Real>& water, Vec3<Real> x) {
    for (int k = 0; k < water.periodic_axes; ++k) x = wrapped(water.periodic_axis[k], x);
    return x;
}

}  // namespace natator::cuda
