#pragma once

#include "natator/model.h"

namespace natator {

/// Moves each fluid particle by up to a fifth of the rest distance along each axis, by its index alone: incompressible
/// particles on a lattice are a crystal, which resists shear, and only disordered ones a liquid.
void disorder_fluid(Model& model);

}  // namespace natator
