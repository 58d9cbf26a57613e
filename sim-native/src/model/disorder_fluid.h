#pragma once

#include "natator/model.h"

namespace natator {

/// Moves each fluid particle by up to a fifth of `spacing` along each axis, the same for the same seed: incompressible
/// particles on a lattice are a crystal, which resists shear, and only disordered ones a liquid.
void disorder_fluid(double spacing, Model& model, int seed = 20);

}  // namespace natator
