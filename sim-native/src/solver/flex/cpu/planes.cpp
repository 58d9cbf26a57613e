#include "flex_stages.h"

namespace natator::cpu {

/// Not pooled with other constraints.
template <class Real>
void FlexStages<Real>::solve_planes() {
    this->resolve_plane_penetrations(this->near_planes());
}

template void FlexStages<float>::solve_planes();
template void FlexStages<double>::solve_planes();

}  // namespace natator::cpu
