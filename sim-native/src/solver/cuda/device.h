#pragma once

#include <string>

namespace natator::cuda {

/// How many GPUs there are; 0 without one, or without its driver.
int device_count();

/// What the current one is: others of that name give the same bits.
std::string current_device_name();

/// Makes a GPU the current one. Throws NoDevice where there is no such one.
void choose_device(int device);

}  // namespace natator::cuda
