#include "conserving_stages.h"

namespace natator::cpu {

/// Pair that is not fluid-fluid, depth e = solidRestDistance - r > 0 (less where it started too deep, contact_depth),
/// n = contacts with e > 0 of a particle:
///   Dx_i = w_i / (w_i n_i + w_j n_j) (e n - f t),
/// t = direction of the tangential relative displacement since the substep's start, m = its length,
/// f = m if m < staticFriction * e, else min(particleFriction * e, m). Friction acts only if dynamicFriction > 0.
/// Shock propagation changes the weights.
template <class Real>
void ConservingStages<Real>::solve_contacts() {
    contact_depth_.resize(ws_.contact.size());
    for (std::size_t k = 0; k < ws_.touched.size(); ++k) {
        const int i = ws_.touched[k];
        int active = 0;
        for (int c = ws_.contact_begin[k]; c < ws_.contact_begin[k + 1]; ++c) {
            contact_depth_[c] = contact_depth(i, ws_.contact[c]);
            active += contact_depth_[c] > 0;
        }
        ws_.constraint_count[i] = static_cast<Real>(active);
    }
    for (std::size_t k = 0; k < ws_.touched.size(); ++k) {
        const int i = ws_.touched[k];
        const Real wi = ws_.inverse_mass[i];
        if (ws_.constraint_count[i] == 0 || wi == 0) continue;
        for (int c = ws_.contact_begin[k]; c < ws_.contact_begin[k + 1]; ++c) {
            const int j = ws_.contact[c];
            const Real depth = contact_depth_[c];
            if (!(depth > 0)) continue;
            const Vector3<Real> difference = position_of_slot(i) - position_of_slot(j);
            const Real r = difference.norm();
            const Vector3<Real> normal = r > 0 ? Vector3<Real>(difference / r) : Vector3<Real>::Zero();
            Vector3<Real> push = depth * normal;
            if (plan_.particle_friction) {
                const Vector3<Real> moved =
                    (position_of_slot(i) - start_of_slot(i)) - (position_of_slot(j) - start_of_slot(j));
                push -= this->friction(moved, normal, depth, constants_.particle_friction);
            }
            Real wj = ws_.inverse_mass[j];
            if (plan_.shock_propagation) wj *= this->shock_factor(i, j);
            const Real split = wi * ws_.constraint_count[i] + wj * ws_.constraint_count[j];
            ws_.correction.add(i, wi / split * push);
        }
    }
    for (const int slot : ws_.touched) this->apply_correction(slot);
}

template void ConservingStages<float>::solve_contacts();
template void ConservingStages<double>::solve_contacts();

}  // namespace natator::cpu
