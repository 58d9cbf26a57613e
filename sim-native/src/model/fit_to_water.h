#pragma once

#include "natator/model.h"

namespace natator {

/// Takes a model of scheme `conserving` to where its pressure solve holds, whatever the scene asks for:
/// - A solid particle weighs at least a fiftieth of the water in its volume. Were it lighter, the solve would move it
///   instead of the water. Its weight then counts as a fiftieth of its buoyancy at most.
/// - Frames have enough substeps for gravity to move nothing further than a tenth of the rest distance in one from
/// rest,
///   and for the passes to hold up the weight of the water: its depth times g h^2, in squared rest distances, is at
///   most twice what physics::velocity_excess allows for each pass.
void fit_to_water(Model& model);

}  // namespace natator
