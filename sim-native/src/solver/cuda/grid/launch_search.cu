#include "search.cuh"
#include "substep.cuh"

namespace natator::cuda {

template <class Real, Scheme scheme>
void launch_predict(const GridLaunch<Real>& launch) {
    launch.clear(launch.slots.arrays.table, 2 * launch.model.grid.cells);
    launch.template each_particle<predict_on_grid<scheme, Real>>();
}

template <class Real>
void launch_sort_into_cells(const GridLaunch<Real>& launch) {
    launch.add_up(launch.slots.arrays.table, 2 * launch.model.grid.cells);
    launch.template each_particle<scatter_into_cells<Real>>();
    launch.template each_particle<order_in_cells<Real>>();
    launch.template each_state<prepare_search<Real>, 32>(1);
}

template <class Real>
void launch_find_neighbours(const GridLaunch<Real>& launch) {
    launch.template each_thread<find_neighbours_on_grid<Real>, search_threads, 12>(launch.model.fluid +
                                                                                   32 * launch.model.solids);
    check(cudaGetLastError(), "launch");
}

#define NATATOR_INSTANTIATE(Real)                                                    \
    template void launch_predict<Real, Scheme::flex>(const GridLaunch<Real>&);       \
    template void launch_predict<Real, Scheme::conserving>(const GridLaunch<Real>&); \
    template void launch_sort_into_cells(const GridLaunch<Real>&);                   \
    template void launch_find_neighbours(const GridLaunch<Real>&)
NATATOR_INSTANTIATE(float);
NATATOR_INSTANTIATE(double);
#undef NATATOR_INSTANTIATE

}  // namespace natator::cuda
