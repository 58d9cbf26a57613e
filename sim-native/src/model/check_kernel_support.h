#pragma once

#include <string>

#include "natator/parameters.h"

namespace natator {

/// Throws InputError, whose message begins with `place`, unless kernelSupport is in limits::least_kernel_support to
/// most_kernel_support: what sums over a kernel would not come to an end.
void check_kernel_support(const SolverParameters& parameters, const std::string& place);

}  // namespace natator
