#pragma once

// Scheme flex for a large State: a kernel per stage, or per stages that need nothing of each other.
#include "search.cuh"
#include "solver/cuda/flex.cuh"

namespace natator::cuda {

/// Compressions, fits of clusters, pushes of contacts.
template <class Real>
__global__ void __launch_bounds__(large_threads)
    density_large(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    if (!slots.failed()) compute_density(model, slots, Real(0));
}

template <class Real>
__global__ void __launch_bounds__(large_threads, 6)
    corrections_large(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    if (!slots.failed()) apply_corrections(model, slots);
}

template <class Real>
__global__ void __launch_bounds__(large_threads)
    movements_large(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    const int s = own_index();
    if (s < model.fluid && !slots.failed()) slots.next()[s] = quad(moved_per_second<Real>(slots, s), Real(0));
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
__device__ void commit_large(const Slots<Real>& slots, int s, const Vec3<Real>& v) {
    const Quad<Real> x = slots.position()[s];
    note_if_bad(slots, s, xyz(x), v);
    slots.at.state_position[s] = x.w > 0 ? x : slots.start()[s];
    slots.at.state_velocity[s] = quad(x.w > 0 ? v : xyz(slots.drift()[s]), as_number<Real>(slots.number()[s]));
}

template <class Real>
__global__ void __launch_bounds__(large_threads, 6)
    velocities_large(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    const int s = own_index();
    if (s >= model.particles || slots.failed()) return;
    commit_large(slots, s, new_velocity(model, slots, s));
}

}  // namespace natator::cuda
