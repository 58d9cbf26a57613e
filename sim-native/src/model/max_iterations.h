#pragma once

#include <algorithm>

#include "natator/model.h"

namespace natator {

/// Constraint iterations that a substep may take: more than `iterations` only in scheme `conserving` with a
/// density_tolerance.
inline int max_iterations(const Model& model) {
    const SolverParameters& p = model.parameters;
    const bool to_tolerance = model.scheme == Scheme::conserving && p.conserving.density_tolerance > 0;
    return to_tolerance ? std::max(p.iterations, p.conserving.max_iterations) : p.iterations;
}

}  // namespace natator
