#pragma once

// Scheme flex by the whole grid: its velocities. Its iteration is that of flex.cuh.
#include "flex.cuh"
#include "solver/cuda/grid/search.cuh"

namespace natator::cuda {

template <class Real>
__device__ void movements_on_grid(const ModelView<Real>&, const Slots<Real>& slots, int s) {
    slots.scratch_position()[s] = quad(displacement_rate<Real>(slots, s), Real(0));
}

/// Notes a slot whose outcome is not finite.
template <class Real>
__device__ void note_if_bad(const Slots<Real>& slots, int s, const Vec3<Real>& x, const Vec3<Real>& v) {
    if (!isfinite(x.x + x.y + x.z) || !isfinite(v.x + v.y + v.z))
        atomicMin(&slots.shared().bad, static_cast<unsigned long long>(slots.substep) << 32 | slots.number()[s]);
}

/// Gives the State slot s's position and velocity, or notes that they are not finite. Particles of infinite mass keep
/// their place.
template <class Real>
__device__ void commit_on_grid(const Slots<Real>& slots, int s, const Vec3<Real>& v) {
    const Vec4<Real> x = slots.position()[s];
    note_if_bad(slots, s, xyz(x), v);
    slots.arrays.state_position[s] = x.w > 0 ? x : slots.start()[s];
    slots.arrays.state_velocity[s] =
        quad(x.w > 0 ? v : xyz(slots.predicted_velocity()[s]), as_number<Real>(slots.number()[s]));
}

template <class Real>
__device__ void velocities_on_grid(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    commit_on_grid(slots, s,
                   new_velocity(model, slots, s, [&](int other) { return xyz(slots.scratch_position()[other]); }));
}

}  // namespace natator::cuda
