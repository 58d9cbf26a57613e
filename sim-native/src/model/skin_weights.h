#pragma once

#include <vector>

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// How a vertex of the skin follows the body: by `share` as cluster `cluster` moves, by the rest as the next one does.
struct SkinWeight {
    int cluster;
    double share;  ///< (0, 1]; 1 at the last cluster
};

/// Of each vertex of the creature's skin: linear along the body between the middles of neighbouring clusters.
std::vector<SkinWeight> skin_weights(const Creature& creature, const Model& model);

}  // namespace natator
