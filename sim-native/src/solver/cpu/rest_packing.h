#pragma once

#include <functional>

namespace natator::cpu {

/// Sum of kernel(r/R) over the neighbours of one particle of the rest packing, without the particle itself. Its spacing
/// is a = ratio * R: 10 neighbours at a and 4 at sqrt(1.5) a (x shifted by a/2 where y + z is odd, rows sqrt(3/4) a
/// apart in y and z), the packing that gives NVIDIA Flex' rest density.
double rest_packing_sum(double ratio, const std::function<double(double)>& kernel);

}  // namespace natator::cpu
