#include "flex_stages.h"

namespace natator::cpu {

/// rho_i = sum over fluid j of W_ij + solidPressure * sum over solid j of W_ij, W = (1 - r/R)^2 / S, without the
/// particle itself and without masses; C_i = max(rho_i - 1, 0). Solids have no density.
template <class Real>
void FlexStages<Real>::compute_density() {
    if (plan_.solid_pressure) {
        std::fill(ws_.solid_density.begin(), ws_.solid_density.end(), Real(0));
        const Real weight = static_cast<Real>(model_.parameters.solidPressure);
        for (std::size_t k = 0; k < ws_.touched.size() && ws_.touched[k] < ws_.fluid; ++k) {
            const int slot = ws_.touched[k];
            Real sum = 0;
            for (int c = ws_.contact_begin[k]; c < ws_.contact_begin[k + 1]; ++c) {
                const Real r = (position_of_slot(slot) - position_of_slot(ws_.contact[c])).norm();
                const Real t = std::max(1 - r * constants_.inverse_radius, Real(0));
                sum += t * t;
            }
            ws_.solid_density[slot] = weight * sum;
        }
    }
    const FluidView<Real> fluid = fluid_view();
    this->on_all_threads(fluid, kernels_->pack);
    this->on_all_threads(fluid, kernels_->compute_density);
}

/// Dx_i = w_i R sum over fluid j of 1/2 (C_i + C_j) (1 - r/R) n, n from j to i. The weight is w_i itself, not a share.
template <class Real>
void FlexStages<Real>::solve_density_constraint() {
    const FluidView<Real> fluid = fluid_view();
    this->on_all_threads(fluid, kernels_->pack);
    this->on_all_threads(fluid, kernels_->solve_density_constraint);
}

template void FlexStages<float>::compute_density();
template void FlexStages<double>::compute_density();
template void FlexStages<float>::solve_density_constraint();
template void FlexStages<double>::solve_density_constraint();

}  // namespace natator::cpu
