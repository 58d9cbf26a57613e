#pragma once

#include "natator/batch.h"
#include "natator/model.h"

namespace natator::cuda {

/// The members' evaluations, some side by side, by the whole current device; by two streams where there are two
/// members.
template <class Real>
std::vector<Evaluation> evaluate_on_grid(const Scene& scene, const Model& model,
                                         const std::vector<BatchMember>& members, const BatchOptions& options);

}  // namespace natator::cuda
