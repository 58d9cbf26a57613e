#pragma once

#include <vector>

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// Of each vertex of the creature's skin: linear along the body between the middles of neighbouring clusters, or that
/// of its regions. `other` is the next cluster; of the last one itself.
std::vector<SkinWeight> skin_weights(const Creature& creature, const Model& model);

}  // namespace natator
