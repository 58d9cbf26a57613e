#pragma once

#include <vector>

#include "natator/evaluate.h"
#include "natator/model.h"
#include "natator/state.h"

namespace natator {

/// The figures of a final state with the densities of its particles, in units of rest density.
template <class Real>
LawFigures law_figures(const Model& model, const State<Real>& state, const std::vector<Real>& densities);

}  // namespace natator
