#include "substep.cuh"
#include "water_neighbours.cuh"

namespace natator::cuda {
namespace {

/// Sums all that is read, so that none of it can be left out. Batches as in water_impulses and push_water_apart.
template <Fetch what, class Real>
__device__ void fetch_pairs(const ModelView<Real>& model, const Slots<Real>& slots, int s, Real* sums) {
    Real sum = 0;
    if constexpr (what == Fetch::velocities) {
        const auto add = [&](const Vec3<Real>& gradient, int, unsigned, const Quad<Real>& v) {
            sum += gradient.x + gradient.y + gradient.z + v.x + v.y + v.z;
        };
        for_each_water_pair<2>(slots, s, add, slots.water.velocity);
    } else {
        const auto add = [&](const Vec3<Real>& gradient, int, unsigned, Real impulse) {
            sum += gradient.x + gradient.y + gradient.z + impulse;
        };
        const Real* const impulse = slots.water.impulse;
        for_each_water_pair(slots, s, add, impulse);
    }
    const Real all = sum_of_lanes(sum);
    if (own_lane() == 0) sums[static_cast<std::size_t>(blockIdx.y) * model.particles + s] = all;
}

}  // namespace

template <class Real>
void launch_fetch(const LargeLaunch<Real>& launch, Fetch what, Real* sums) {
    // Of floats as many blocks on a multiprocessor as the passes ask for.
    constexpr bool single = std::is_same_v<Real, float>;
    const int particles = launch.model.particles;
    if (what == Fetch::velocities)
        launch.template each_slot<fetch_pairs<Fetch::velocities, Real>, pair_lanes, large_threads, single ? 6 : 0>(
            particles, sums);
    else
        launch.template each_slot<fetch_pairs<Fetch::impulses, Real>, pair_lanes, large_threads, single ? 8 : 0>(
            particles, sums);
    check(cudaGetLastError(), "launch");
}

template void launch_fetch(const LargeLaunch<float>&, Fetch, float*);
template void launch_fetch(const LargeLaunch<double>&, Fetch, double*);

}  // namespace natator::cuda
