#pragma once

#include <string>

#include "natator/gait.h"

namespace natator::cli {

/// The gait that --gait gives, a file or JSON text. Throws InputError.
Gait read_gait_argument(const std::string& argument);

}  // namespace natator::cli
