#pragma once

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// Adds a creature's particles, clusters and muscles, `own`, behind what the model holds: a body of another group, that
/// other bodies collide with.
void add_companion(const Model& own, const Gait& gait, Model& model);

/// Throws InputError, which body and where, if bodies overlap each other or an obstacle.
void check_apart(const Scene& scene, const Model& model);

}  // namespace natator
