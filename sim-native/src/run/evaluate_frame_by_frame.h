#pragma once

#include <vector>

#include "natator/batch.h"

namespace natator {

/// Evaluates members of a scene by Solvers, frame by frame together, as `evaluate` does each alone; the perturbation of
/// `options` is of none, its snapshot and calls are of the first. On a GPU that `options.execution` shares by the same
/// kernels.
std::vector<Evaluation> evaluate_frame_by_frame(const Scene& scene, const std::vector<BatchMember>& members,
                                                const EvaluationOptions& options);

}  // namespace natator
