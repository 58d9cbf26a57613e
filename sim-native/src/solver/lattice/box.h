#pragma once

#include "natator/water_box.h"

namespace natator::lattice {

using Box = WaterBox;
using Face = WaterFace;

}  // namespace natator::lattice
