#pragma once

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// Adds the fluid's lattice points, in the order x, y, z (z fastest), to a model that holds the body already; points
/// closer than `clearance` to a body particle are left out. Masses follow the layer's height (thesis 2.3).
void add_fluid(const FluidBlock& block, Model& model);

}  // namespace natator
