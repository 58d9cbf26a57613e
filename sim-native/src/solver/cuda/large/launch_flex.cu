#include "flex_kernels.cuh"
#include "substep.cuh"

namespace natator::cuda {

template <class Real, Scheme scheme>
void launch_substep_of(const LargeLaunch<Real>& launch) {
    static_assert(scheme == Scheme::flex);
    const ModelView<Real>& model = launch.model;
    const Slots<Real>& slots = launch.slots;
    const int blocks = blocks_for(model.particles, large_threads);
    const int fits = blocks_for(model.clusters, large_threads / 32);
    launch_search<Real, scheme>(launch);
    if (model.plan.dissipation) overlaps_large<<<blocks, large_threads, 0, launch.stream>>>(model, slots);
    launch.mark("neighbours");
    for (int i = 0; i < model.iterations; ++i) {
        density_large<<<blocks + fits, large_threads, 0, launch.stream>>>(model, slots);
        launch.mark("density and shape fit");
        corrections_large<<<blocks, large_threads, 0, launch.stream>>>(model, slots);
        launch.mark("corrections and planes");
        record_positions(launch, launch.trace.iterated, slots.substep * model.iterations + i);
    }
    if (model.plan.viscosity) movements_large<<<blocks, large_threads, 0, launch.stream>>>(model, slots);
    velocities_large<<<blocks, large_threads, 0, launch.stream>>>(model, slots);
    launch.mark("velocities");
    check(cudaGetLastError(), "launch");
}

template void launch_substep_of<float, Scheme::flex>(const LargeLaunch<float>&);
template void launch_substep_of<double, Scheme::flex>(const LargeLaunch<double>&);

}  // namespace natator::cuda
