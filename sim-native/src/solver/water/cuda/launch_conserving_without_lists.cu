#include "conserving_launches.cuh"

namespace natator::cuda {

template <class Real>
void launch_substep_without_lists(const GridLaunch<Real>& launch) {
    launch_by<ConservingLaunches<Pairs::searched, Real>>(launch);
}

template void launch_substep_without_lists(const GridLaunch<float>&);
template void launch_substep_without_lists(const GridLaunch<double>&);

}  // namespace natator::cuda
