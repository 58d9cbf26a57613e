#pragma once

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// Throws InputError, which names the scene and what is wrong, unless the tank can be periodic along the axes that the
/// scene says, with what `model` has of particles.
void check_periodic(const Scene& scene, const Model& model);

}  // namespace natator
