#pragma once

#include "natator/model.h"

namespace natator {

/// Throws InputError unless a model's lists belong together: as many velocities, masses and phases as positions, and springs,
/// clusters, muscles and bodies of particles, springs and actuators that are there.
void check_model(const Model& model);

}  // namespace natator
