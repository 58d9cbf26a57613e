#pragma once

#include "natator/model.h"

namespace natator::lattice {

using Box = WaterBox;
using Face = WaterFace;

}  // namespace natator::lattice
