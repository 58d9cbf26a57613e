#pragma once

#include "natator/batch.h"
#include "natator/model.h"

namespace natator::cuda {

/// Scenes of more particles are computed by kernels of the whole GPU; smaller ones by blocks of their own. What a scene gives
/// must not depend on the others, so the choice does not either.
inline constexpr int most_particles_of_a_block = 20000;

/// Whether members are computed so: all but scheme flex is, and what has goals or companions; `asked`: for every scene.
inline bool by_whole_gpu(const Scene& scene, const Model& model, bool asked) {
    return asked || !scene.goals.empty() || !scene.companions.empty() || model.scheme != Scheme::flex ||
           model.particles() > most_particles_of_a_block;
}

/// The members' evaluations, some side by side, by the whole current device; by two streams where there are two members.
template <class Real>
std::vector<Evaluation> evaluate_large(const Scene& scene, const Model& model, const std::vector<BatchMember>& members,
                                       BatchTimes* times);

}  // namespace natator::cuda
