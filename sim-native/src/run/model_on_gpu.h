#pragma once

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// Do Models of a scene differ in nothing but where their water begins, or in scheme lattice their bodies?
bool differ_in_places_alone(const Model& a, const Model& b);

/// What a GPU has of a Model of the scene: where nothing but places depends on the water's arrangement, the Model
/// of the usual one, so that bits do not depend on who else is there. An arrangement that asks for more substeps, say,
/// has its own.
Model model_on_gpu(Scene scene, const Model& own);

}  // namespace natator
