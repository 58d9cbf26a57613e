#include "solver/cuda/grid/substep.cuh"
#include "water_kernels.cuh"

namespace natator::cuda {
namespace {

/// Sums all that is read, so that none of it can be left out. As many at a time as in water_impulses and
/// push_water_apart.
template <Fetch what, int lanes, class Real>
__device__ void fetch_pairs(const ModelView<Real>& model, const Slots<Real>& slots, int s, Real* sums) {
    ListSums<lanes, Real> sum;
    if constexpr (what == Fetch::velocities) {
        const auto add = [&](int list, const Vec3<Real>& gradient, unsigned, const Vec4<Real>& v) {
            sum[list] += gradient.x + gradient.y + gradient.z + v.x + v.y + v.z;
        };
        for_each_listed_pair<lanes, rows_of_velocities<lanes>, velocities_at_once>(slots, s, add, slots.water.velocity);
    } else {
        const auto add = [&](int list, const Vec3<Real>& gradient, unsigned, Real impulse) {
            sum[list] += gradient.x + gradient.y + gradient.z + impulse;
        };
        const Real* const impulse = slots.water.impulse;
        for_each_listed_pair<lanes, rows_of_impulses<lanes>, impulses_at_once>(slots, s, add, impulse);
    }
    const Real all = sum.total();
    if (sum.first_lane()) sums[static_cast<std::size_t>(blockIdx.y) * model.particles + s] = all;
}

}  // namespace

template <class Real>
void launch_fetch(const GridLaunch<Real>& launch, Fetch what, Real* sums) {
    // Of floats as many blocks on a multiprocessor as the passes ask for.
    constexpr bool single = std::is_same_v<Real, float>;
    const int particles = launch.model.particles;
    if (what == Fetch::velocities)
        launch.template each_slot<fetch_pairs<Fetch::velocities, few_lanes, Real>, few_lanes, grid_threads,
                                  single ? blocks_of_velocities : 0>(particles, sums);
    else
        launch.template each_slot<fetch_pairs<Fetch::impulses, few_lanes, Real>, few_lanes, grid_threads,
                                  single ? blocks_of_impulses : 0>(particles, sums);
    check(cudaGetLastError(), "launch");
}

template void launch_fetch(const GridLaunch<float>&, Fetch, float*);
template void launch_fetch(const GridLaunch<double>&, Fetch, double*);

}  // namespace natator::cuda
