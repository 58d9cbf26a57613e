// When an evaluation ends before its time: thesis 2.6.
#pragma once

#include "constants.h"
#include "number.h"

namespace natator::physics::inline NATATOR_SET {

/// Whether the last `window` frames brought no gain. `path` has the body's mean x at the start and after each of
/// `frames` frames; a window of 0 never ends a run.
NATATOR_HD bool without_progress(const double* path, int frames, long window) {
    return window > 0 && frames >= window && path[frames] - path[frames - window] <= 0;
}

/// Does a particle touch the plane of this offset that it is `distance` from?
NATATOR_HD bool touches(double distance, double collision_distance, double offset) {
    const double size = offset < 0 ? -offset : offset;
    return distance <= collision_distance + measured_touch * (size + 1);
}

}  // namespace natator::physics::inline NATATOR_SET
