#pragma once

#include "base/field.h"
#include "natator/scene.h"

namespace natator {

/// Throws InputError unless lists of a scene have the sizes that belong together, slices that are named are there, and
/// counts, lengths and masses are above 0, and kernel_support is within its limits. Readers of files have checked that
/// and more; a Scene that a program makes may hold anything.
void check_scene(const Scene& scene);

}  // namespace natator

namespace natator::fields {

/// Throws InputError unless the plane's normal has length 1 and its offset is a number.
void check_plane(const Plane& plane, const Place& place);
/// Throws InputError if scheme `conserving` cannot compute the water of a scene: with this viscosity at this time step,
/// beside planes that meet like these, and by its modified pressure in this tank.
void check_water(const Scene& scene, const Place& place);
/// Throws InputError if a body's particles are nearer to each other than lengths that the scheme does not tell from
/// none.
void check_bodies(const Scene& scene, const Place& place);

}  // namespace natator::fields
