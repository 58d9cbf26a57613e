#pragma once

#include "natator/gait.h"

namespace natator {

/// Refuses a gait whose lists have not one value for each actuator.
void check_lengths(const Gait& gait, int actuators);

}  // namespace natator
