#pragma once

#include <string>

#include "physics/laws.h"

namespace natator {

/// The name of a law in results: "finite", "particle-energy", "energy", "tank", "shape", "compression", "mach"; "" of
/// none.
const char* name(physics::Law law);
/// Whose name that is; none if it is no law's.
physics::Law law_named(const std::string& text);

}  // namespace natator
