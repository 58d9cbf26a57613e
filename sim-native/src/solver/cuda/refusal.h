#pragma once

#include <optional>
#include <string>

#include "natator/model.h"
#include "natator/solver.h"

namespace natator::cuda {

/// Why scenes of this Model cannot be computed; none if they can.
std::optional<std::string> refusal(const Model& model);

/// Names the stage that made a State unstable: the CPU does the substep again, from the State before it. `found` says
/// what the GPU saw: it stands if the CPU finds nothing. `drive`: of the muscles; empty leaves them as they are.
template <class Real>
Instability located(const Model& model, State<Real> before, const Drive& drive, double time_step, int substeps,
                    double frame_time, const Instability& found);

}  // namespace natator::cuda
