#include "scan.h"
#include "search.cuh"
#include "substep.cuh"

namespace natator::cuda {

template <class Real, Scheme scheme>
void launch_search(const LargeLaunch<Real>& launch) {
    const ModelView<Real>& model = launch.model;
    const Slots<Real>& slots = launch.slots;
    const int blocks = blocks_for(model.particles, large_threads), cells = 2 * model.grid.cells;
    check(cudaMemsetAsync(slots.at.table, 0, cells * sizeof(int), launch.stream), "clear");
    predict_large<scheme><<<blocks, large_threads, 0, launch.stream>>>(model, slots);
    launch.mark("predict");
    exclusive_scan(slots.at.table, cells, launch.scan_room, launch.scan_bytes, launch.stream);
    scatter_into_cells<<<blocks, large_threads, 0, launch.stream>>>(model, slots);
    order_in_cells<<<blocks, large_threads, 0, launch.stream>>>(model, slots);
    prepare_search<<<1, 32, 0, launch.stream>>>(model, slots);
    launch.mark("cells");
    record_positions(launch, launch.trace.predicted, slots.substep);
    find_neighbours_large<<<blocks_for(model.particles, search_threads), search_threads, 0, launch.stream>>>(model,
                                                                                                             slots);
    check(cudaGetLastError(), "launch");
}

template void launch_search<float, Scheme::flex>(const LargeLaunch<float>&);
template void launch_search<double, Scheme::flex>(const LargeLaunch<double>&);
template void launch_search<float, Scheme::conserving>(const LargeLaunch<float>&);
template void launch_search<double, Scheme::conserving>(const LargeLaunch<double>&);

}  // namespace natator::cuda
