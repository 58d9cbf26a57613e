#pragma once

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// Makes each particle of a body, which is all that the model holds so far, n x n x n ones: n = creature.refinement, on
/// a lattice n times as fine about its place, each of its mass / n^3. What is kept:
/// - the outer shape, taking a particle for a cube of its spacing: a body of k particles across was k spacings thick,
///   and is k n fine spacings thick; so its volume, its mass and its centre of mass are, in each slice and cluster;
/// - slices and clusters: those of the particles that a fine one belongs to;
/// - muscles: a spring becomes n^3, which join the fine particles in the same place of its two ends, so that all have
///   its rest length. Its relative change of length goes on linearly across the body: lateral (Muscle) counts from the
///   middle in half widths (bending up and down: half heights) of the described slice, and is beyond 1 for the
///   outermost. So the curvature that the muscles ask for is the same. Between Regions it stays that of the spring.
/// Stiffnesses are relative to masses (physics::softness), so the springs of a muscle, and a cluster, are together as
/// stiff as they were; the stiffness of bending follows the second moments of the particles' places, which on the finer
/// lattice are closer to those of the solid shape.
/// `plane`: the body is in plane flow, and each particle becomes n x 1 x n of mass / n^2.
void refine_body(const Creature& creature, bool plane, Model& model);

}  // namespace natator
