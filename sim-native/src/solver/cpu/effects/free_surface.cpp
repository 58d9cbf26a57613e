#include <algorithm>

#include "../substep.h"

namespace natator::cpu {

/// dv/dt = -freeSurfaceDrag max(1 - density, 0) v for fluid particles, by implicit Euler: full drag for a particle
/// alone, none where the fluid has its rest density. The density is that of the last iteration.
template <class Real>
void Substep<Real>::drag_free_surface() {
    const Real step = h_ * static_cast<Real>(model_.parameters.freeSurfaceDrag);
    for (const int i : ws_.fluid_ids) {
        const Real lacking = std::max(1 - ws_.density[ws_.slot_of[i]], Real(0));
        new_velocity_[i] = new_velocity_[i] / (1 + step * lacking);
    }
}

template void Substep<float>::drag_free_surface();
template void Substep<double>::drag_free_surface();

}  // namespace natator::cpu
