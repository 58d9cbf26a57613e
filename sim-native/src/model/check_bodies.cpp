#include <sstream>

#include "check_scene.h"
#include "physics/constants.h"

namespace natator::fields {
namespace {

/// `spacing` of the creature as it is built: a refined one has more particles in the same body.
void check_spacing(const Scene& scene, const Creature& creature, const Place& place) {
    const bool flex = scene.scheme == Scheme::flex;
    if (!flex && scene.planes.empty()) return;
    const double least = flex ? physics::min_flex_spacing : physics::min_touch_spacing;
    if (creature.spacing / creature.refinement >= least) return;
    std::ostringstream text;
    text << "at least " << least;
    if (creature.refinement > 1) text << " at " << creature.refinement << " times as many particles along each axis";
    text << (flex ? " in scheme flex, which does not move a cluster's centre by less than 1e-5"
                  : " beside planes, which count as touched from 1e-6 away")
         << "; take another unit of length";
    refuse(place.key("spacing"), creature.spacing, text.str());
}

}  // namespace

void check_bodies(const Scene& scene, const Place& place) {
    if (scene.creature) check_spacing(scene, *scene.creature, place.key("creature"));
    for (std::size_t k = 0; k < scene.companions.size(); ++k)
        check_spacing(scene, scene.companions[k].creature, place.key("companions").item(k).key("creature"));
}

}  // namespace natator::fields
