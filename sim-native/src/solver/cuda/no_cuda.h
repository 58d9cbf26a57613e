#pragma once

namespace natator {

/// Throws the NoDevice of a build without CUDA.
[[noreturn]] void refuse_without_cuda();

}  // namespace natator
