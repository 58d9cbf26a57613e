#include "scan.h"
#include "search.cuh"
#include "substep.cuh"

namespace natator::cuda {

template <class Real, Scheme scheme>
void launch_predict(const LargeLaunch<Real>& launch) {
    const ModelView<Real>& model = launch.model;
    check(cudaMemsetAsync(launch.slots.at.table, 0, 2 * model.grid.cells * sizeof(int), launch.stream), "clear");
    predict_large<scheme>
        <<<blocks_for(model.particles, large_threads), large_threads, 0, launch.stream>>>(model, launch.slots);
}

template <class Real>
void launch_sort_into_cells(const LargeLaunch<Real>& launch) {
    const ModelView<Real>& model = launch.model;
    const Slots<Real>& slots = launch.slots;
    const int blocks = blocks_for(model.particles, large_threads);
    exclusive_scan(slots.at.table, 2 * model.grid.cells, launch.scan_room, launch.scan_bytes, launch.stream);
    scatter_into_cells<<<blocks, large_threads, 0, launch.stream>>>(model, slots);
    order_in_cells<<<blocks, large_threads, 0, launch.stream>>>(model, slots);
    prepare_search<<<1, 32, 0, launch.stream>>>(model, slots);
}

template <class Real>
void launch_find_neighbours(const LargeLaunch<Real>& launch) {
    const int blocks = blocks_for(launch.model.particles, search_threads);
    find_neighbours_large<<<blocks, search_threads, 0, launch.stream>>>(launch.model, launch.slots);
    check(cudaGetLastError(), "launch");
}

#define NATATOR_INSTANTIATE(Real)                                                   \
    template void launch_predict<Real, Scheme::flex>(const LargeLaunch<Real>&);       \
    template void launch_predict<Real, Scheme::conserving>(const LargeLaunch<Real>&); \
    template void launch_sort_into_cells(const LargeLaunch<Real>&);                   \
    template void launch_find_neighbours(const LargeLaunch<Real>&)
NATATOR_INSTANTIATE(float);
NATATOR_INSTANTIATE(double);
#undef NATATOR_INSTANTIATE

}  // namespace natator::cuda
