#include "flex_stages.h"

namespace natator::cpu {

/// rho_i and C_i (physics/flex_density.h); solids have no density, but add solidPressure * W to that of the fluid.
template <class Real>
void FlexStages<Real>::compute_density() {
    if (plan_.solid_pressure) {
        std::fill(ws_.solid_density.begin(), ws_.solid_density.end(), Real(0));
        const Real weight = static_cast<Real>(model_.parameters.flex.solidPressure);
        for (std::size_t k = 0; k < ws_.contact_slots.size() && ws_.contact_slots[k] < ws_.fluid; ++k) {
            const int slot = ws_.contact_slots[k];
            Real sum = 0;
            for (int c = ws_.contact_begin[k]; c < ws_.contact_begin[k + 1]; ++c) {
                const Real r = norm(position_of_slot(slot) - position_of_slot(ws_.contact[c]));
                sum += physics::positive_square(1 - r * constants_.inverse_radius);
            }
            ws_.solid_density[slot] = weight * sum;
        }
    }
    const FluidView<Real> fluid = fluid_view();
    this->on_all_threads(fluid, kernels_->pack);
    this->on_all_threads(fluid, kernels_->compute_density);
}

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
