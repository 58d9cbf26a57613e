#include <cmath>

#include "conserving_stages.h"

namespace natator::cpu {

/// Distance constraint C = l - l0 by XPBD (Macklin, Müller, Chentanez 2016, eq. 18) with split masses, n = springs on a
/// particle: Dlambda = (-C - alpha lambda) / (w_a n_a + w_b n_b + alpha), Dx_a = w_a Dlambda n.
template <class Real>
void ConservingStages<Real>::solve_springs() {
    for (std::size_t s = 0; s < model_.springs.size(); ++s) {
        const Spring& spring = model_.springs[s];
        const int a = ws_.slot_of[spring.a];
        const int b = ws_.slot_of[spring.b];
        const Real wa = ws_.inverse_mass[a], wb = ws_.inverse_mass[b];
        const Vector3<Real> difference = position_of_slot(a) - position_of_slot(b);
        const Real length = difference.norm();
        const double compliance = relative_compliance(spring.stiffness, h_) * static_cast<double>(wa + wb);
        if (!std::isfinite(compliance) || wa + wb == 0 || !(length > 0)) continue;
        const Real alpha = static_cast<Real>(compliance);
        const Real split = wa * static_cast<Real>(springs_per_particle_[spring.a]) +
                           wb * static_cast<Real>(springs_per_particle_[spring.b]);
        const Real stretch = length - state_->spring_rest_length[s];
        const Real change = (-stretch - alpha * spring_lambda_[s]) / (split + alpha);
        spring_lambda_[s] += change;
        const Vector3<Real> push = change / length * difference;
        ws_.correction.add(a, wa * push);
        ws_.correction.add(b, -wb * push);
    }
    apply_internal_corrections();
}

template void ConservingStages<float>::solve_springs();
template void ConservingStages<double>::solve_springs();

}  // namespace natator::cpu
