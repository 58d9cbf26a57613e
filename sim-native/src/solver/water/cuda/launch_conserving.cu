#include "conserving_launches.cuh"

namespace natator::cuda {

template <class Real, Scheme scheme>
void launch_substep_of(const GridLaunch<Real>& launch) {
    static_assert(scheme == Scheme::conserving);
    if (launch.model.plan.water && !launch.slots.lists_water())
        launch_substep_without_lists(launch);
    else
        launch_by<ConservingLaunches<Pairs::listed, Real>>(launch);
}

template void launch_substep_of<float, Scheme::conserving>(const GridLaunch<float>&);
template void launch_substep_of<double, Scheme::conserving>(const GridLaunch<double>&);

}  // namespace natator::cuda
