#pragma once

#include "natator/scene.h"

namespace natator {

/// Throws InputError unless lists of a scene have the sizes that belong together, slices that are named are there, and counts,
/// lengths and masses are above 0, and kernelSupport is within its limits. Readers of files have checked that and more; a Scene that
/// a program makes may hold anything.
void check_scene(const Scene& scene);

}  // namespace natator
