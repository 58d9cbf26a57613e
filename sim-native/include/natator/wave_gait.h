#pragma once

#include "natator/gait.h"
#include "natator/scene.h"

namespace natator {

/// A gait to begin with: a wave that runs from head to tail and grows on its way, at 2 beats a second, half a wave on the
/// body. Muscles that bend another way than the first rest. Values are rounded to hundredths. Every bundled creature swims
/// by it.
Gait wave_gait(const Creature& creature);

}  // namespace natator
