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
void ConservingStages<Real>::add_spring_work(const std::vector<Real>& before, std::vector<double>& work) const {
    const double relaxation = static_cast<double>(constants_.relaxation_factor), h = static_cast<double>(h_);
    for (int k = 0; k < model_.swimmers(); ++k) {
        double own = 0;
        for (int s = model_.first_spring_of(k); s < model_.first_spring_of(k + 1); ++s) {
            const double change = static_cast<double>(state_->spring_rest_length[s]) - static_cast<double>(before[s]);
            own += physics::spring_work(relaxation * static_cast<double>(spring_lambda_[s]), h, change);
        }
        work[k] += own;
    }
}

template void ConservingStages<float>::solve_springs();
template void ConservingStages<double>::solve_springs();
template void ConservingStages<float>::add_spring_work(const std::vector<float>&, std::vector<double>&) const;
template void ConservingStages<double>::add_spring_work(const std::vector<double>&, std::vector<double>&) const;

}  // namespace natator::cpu
