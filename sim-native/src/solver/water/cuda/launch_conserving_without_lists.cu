#include "conserving_launches.cuh"

namespace natator::cuda {

template <class Real>
void launch_substep_without_lists(const LargeLaunch<Real>& launch) {
    launch_by<ConservingLaunches<Pairs::searched, Real>>(launch);
}

template void launch_substep_without_lists(const LargeLaunch<float>&);
template void launch_substep_without_lists(const LargeLaunch<double>&);

}  // namespace natator::cuda
