#pragma once

#include <cstdint>

#include "natator/instruction_set.h"

namespace natator::bench {

/// Loops that do nothing but what a roof of the processor stands for, in one instruction set. Each returns a sum, so
/// that none of its work can be left out.
struct RoofKernels {
    int width;  ///< floats per vector
    /// 12 independent chains of fused multiply-adds, `rounds` long, of vectors.
    float (*multiply_add)(int rounds);
    /// Sum of `count` floats, a multiple of 64, aligned to 64 bytes.
    float (*sum)(const float* from, int count);
    /// Sum of the quadruples index[0 .. count) out of `packed`, fetched as the fluid kernels do; count a multiple
    /// of 16.
    float (*sum_quadruples)(const float* packed, const std::int32_t* index, int count);
};

namespace portable {
RoofKernels roof_kernels();
}
namespace avx2 {
RoofKernels roof_kernels();
}
namespace avx512 {
RoofKernels roof_kernels();
}
namespace neon {
RoofKernels roof_kernels();
}

/// Those of the instruction set in use.
RoofKernels roof_kernels();

}  // namespace natator::bench
