#include "flex_stages.h"

namespace natator::cpu {

/// Pair that is not fluid-fluid, depth e = solidRestDistance - r > 0:
///   Dx_i = w_i / (w_i + w_j) (e n - f t),
/// t = direction of the tangential relative displacement since the substep's start, m = its length,
/// f = m if m < staticFriction * e, else min(particleFriction * e, m). Friction acts only if dynamicFriction > 0.
/// Shock propagation changes the weights.
template <class Real>
void FlexStages<Real>::solve_contacts() {
    for (std::size_t k = 0; k < ws_.touched.size(); ++k) {
        const int i = ws_.touched[k];
        const Vector3<Real> xi = position_of_slot(i);
        const Real wi = ws_.inverse_mass[i];
        for (int c = ws_.contact_begin[k]; c < ws_.contact_begin[k + 1]; ++c) {
            const int j = ws_.contact[c];
            const Vector3<Real> difference = xi - position_of_slot(j);
            const Real r = difference.norm();
            const Real depth = constants_.solid_rest_distance - r;
            if (!(depth > 0)) continue;
            Real wj = ws_.inverse_mass[j];
            if (plan_.shock_propagation) wj *= this->shock_factor(i, j);
            const Real weights = wi + wj;
            const Real share = weights > 0 ? wi / weights : Real(0);
            const Vector3<Real> normal = r > 0 ? Vector3<Real>(difference / r) : Vector3<Real>::Zero();
            Vector3<Real> push = depth * normal;
            if (plan_.particle_friction) {
                const Vector3<Real> moved = (xi - start_of_slot(i)) - (position_of_slot(j) - start_of_slot(j));
                push -= this->friction(moved, normal, depth, constants_.particle_friction);
            }
            add_correction(i, share * push);
        }
    }
}

template void FlexStages<float>::solve_contacts();
template void FlexStages<double>::solve_contacts();

}  // namespace natator::cpu
