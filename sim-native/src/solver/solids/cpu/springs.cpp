#include "conserving_stages.h"

namespace natator::cpu {

template <class Real>
void ConservingStages<Real>::solve_springs() {
    for (std::size_t s = 0; s < model_.springs.size(); ++s) {
        const Spring& spring = model_.springs[s];
        const int a = ws_.slot_of[spring.a];
        const int b = ws_.slot_of[spring.b];
        const Real wa = ws_.inverse_mass[a], wb = ws_.inverse_mass[b];
        const Real split = wa * static_cast<Real>(springs_per_particle_[spring.a]) +
                           wb * static_cast<Real>(springs_per_particle_[spring.b]);
        const Vec3<Real> push =
            physics::xpbd_spring_push(position_of_slot(a) - position_of_slot(b), wa + wb, split,
                                      state_->spring_rest_length[s], spring_rules_[s], h_, spring_lambda_[s]);
        ws_.correction.add(a, wa * push);
        ws_.correction.add(b, -wb * push);
    }
    apply_internal_corrections();
}

template <class Real>
MuscleWork ConservingStages<Real>::spring_work(const std::vector<Real>& before) const {
    const double relaxation = static_cast<double>(constants_.relaxation_factor), h = static_cast<double>(h_);
    MuscleWork work;
    const auto own = static_cast<std::size_t>(own_springs(model_));
    for (std::size_t s = 0; s < before.size(); ++s) {
        const double change = static_cast<double>(state_->spring_rest_length[s]) - static_cast<double>(before[s]);
        work.all += physics::spring_work(relaxation * static_cast<double>(spring_lambda_[s]), h, change);
        if (s + 1 == own) work.own = work.all;
    }
    return work;
}

template void ConservingStages<float>::solve_springs();
template void ConservingStages<double>::solve_springs();
template MuscleWork ConservingStages<float>::spring_work(const std::vector<float>&) const;
template MuscleWork ConservingStages<double>::spring_work(const std::vector<double>&) const;

}  // namespace natator::cpu
