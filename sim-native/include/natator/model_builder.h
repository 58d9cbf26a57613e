#pragma once

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// Lays out the particles, clusters and muscles of a scene: first the body (by slice from the head, then y, then z),
/// then the fluid (by x, then y, then z). Springs are sorted by actuator, front particle, rear particle; springs that
/// join the same two particles are separate, neighbouring entries. A creature's `refinement` n makes each particle of its
/// body n x n x n of them, one after the other by x, then y, then z, as model/refine_body.h says.
/// Throws InputError when the scene has no particles, or more particles or springs than limits.h allows, when a particle starts
/// beyond a plane, and when an actuator has no muscle. Of a Scene that a program made it is checked, too, that lists have sizes that
/// belong together, that slices which are named are there, that counts, lengths and masses are above 0, the duration is a
/// number and normals of planes have length 1; that the solver's parameters have the ranges of sim-native/protocol/scenes.md, and that
/// scheme `conserving` can compute the water by them and beside these planes. All else has the ranges of that page, which load_scene and
/// parse_scene have checked.
Model build_model(const Scene& scene);

}  // namespace natator
