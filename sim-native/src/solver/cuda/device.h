#pragma once

#include <string>

namespace natator::cuda {

/// Number of GPUs; 0 without one, or without its driver.
int device_count();

/// Name of the current GPU: others of that name give the same bits.
std::string current_device_name();

/// Makes a GPU the current one. Throws NoDevice where there is no such one.
void choose_device(int device);

}  // namespace natator::cuda
