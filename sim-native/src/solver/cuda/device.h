#pragma once

namespace natator::cuda {

/// Makes a GPU the current one. Throws NoDevice where there is no such one.
void choose_device(int device);

}  // namespace natator::cuda
