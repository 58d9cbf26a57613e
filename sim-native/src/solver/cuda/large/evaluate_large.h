#pragma once

#include "natator/batch.h"
#include "natator/model.h"

namespace natator::cuda {

/// Scenes of more particles are computed one by one, each by the whole GPU; smaller ones in batches, a block each. What
/// a scene gives must not depend on the others, so the choice does not either.
inline constexpr int most_particles_of_a_block = 20000;

/// The members' evaluations, one after another, each by the whole current device.
template <class Real>
std::vector<Evaluation> evaluate_large(const Scene& scene, const Model& model, const std::vector<BatchMember>& members,
                                       BatchTimes* times);

}  // namespace natator::cuda
