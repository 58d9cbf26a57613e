#include "conserving_launches.cuh"

namespace natator::cuda {

template <class Real, Scheme scheme>
void launch_substep_of(const LargeLaunch<Real>& launch) {
    static_assert(scheme == Scheme::conserving);
    launch_by<ConservingLaunches<Real>>(launch);
}

template void launch_substep_of<float, Scheme::conserving>(const LargeLaunch<float>&);
template void launch_substep_of<double, Scheme::conserving>(const LargeLaunch<double>&);

}  // namespace natator::cuda
