#pragma once

#include <vector>

#include "natator/evaluate.h"
#include "natator/model.h"

namespace natator {

/// How far a state is from the laws of mechanics, with the densities of its particles in units of rest density.
template <class Real>
ConservationErrors conservation_errors(const Model& model, const State<Real>& state,
                                       const std::vector<Real>& densities);

}  // namespace natator
