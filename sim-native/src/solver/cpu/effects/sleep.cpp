#include "../substep.h"

namespace natator::cpu {

/// A particle that ends the substep slower than sleep_threshold stays where it started and loses its velocity.
/// (NVIDIA Flex was measured to hold its position too, but to report v - v_x in every component as its velocity.)
template <class Real>
void Substep<Real>::apply_sleep() {
    const Real threshold = static_cast<Real>(model_.parameters.sleep_threshold);
    for (int i = 0; i < ws_.particles; ++i) {
        if (!(norm(new_velocity_[i]) < threshold)) continue;
        new_velocity_[i] = {};
        ws_.position.set(ws_.slot_of[i], vec3(state_->position[i]));
    }
}

template void Substep<float>::apply_sleep();
template void Substep<double>::apply_sleep();

}  // namespace natator::cpu
