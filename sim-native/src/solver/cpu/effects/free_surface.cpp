#include "../substep.h"
#include "physics/effects.h"

namespace natator::cpu {

/// The density is that of the last iteration.
template <class Real>
void Substep<Real>::drag_free_surface() {
    const Real step = h_ * static_cast<Real>(model_.parameters.free_surface_drag);
    for (const int i : ws_.fluid_ids)
        new_velocity_[i] = physics::dragged(new_velocity_[i], ws_.density[ws_.slot_of[i]], step);
}

template void Substep<float>::drag_free_surface();
template void Substep<double>::drag_free_surface();

}  // namespace natator::cpu
