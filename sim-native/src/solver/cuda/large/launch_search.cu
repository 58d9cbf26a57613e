#include "search.cuh"
#include "substep.cuh"

namespace natator::cuda {

template <class Real, Scheme scheme>
void launch_predict(const LargeLaunch<Real>& launch) {
    const ModelView<Real>& model = launch.model;
    launch.clear(launch.slots.at.table, 2 * model.grid.cells);
    predict_large<scheme>
        
            <<<launch.grid(blocks_for(model.particles, large_threads)), large_threads, 0, launch.stream>>>(
                model, launch.slots);
}

template <class Real>
void launch_sort_into_cells(const LargeLaunch<Real>& launch) {
    const ModelView<Real>& model = launch.model;
    const Slots<Real>& slots = launch.slots;
    const int blocks = blocks_for(model.particles, large_threads);
    launch.add_up(slots.at.table, 2 * model.grid.cells);
    scatter_into_cells<<<launch.grid(blocks), large_threads, 0, launch.stream>>>(model, slots);
    order_in_cells<<<launch.grid(blocks), large_threads, 0, launch.stream>>>(model, slots);
    prepare_search<<<launch.grid(1), 32, 0, launch.stream>>>(model, slots);
}

template <class Real>
void launch_find_neighbours(const LargeLaunch<Real>& launch) {
    const int blocks = blocks_for(launch.model.particles, search_threads);
    find_neighbours_large<<<launch.grid(blocks), search_threads, 0, launch.stream>>>(launch.model, launch.slots);
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
