#include "conserving_stages.h"

namespace natator::cpu {

template <class Real>
DensityView<Real> ConservingStages<Real>::density_view() {
    const auto pointers = [](auto& array) { return std::array{array.x.data(), array.y.data(), array.z.data()}; };
    const auto position = pointers(ws_.position);
    const auto correction = pointers(ws_.correction);
    const auto velocity = pointers(ws_.velocity);
    const auto gradient = pointers(solid_gradient_);
    return {.blocks = ws_.blocks(),
            .row_begin = ws_.row_begin.data(),
            .neighbour = ws_.neighbour.data(),
            .inverse_radius = constants_.inverse_radius,
            .kernel_scale = kernel_scale_,
            .gradient_scale = gradient_scale_,
            .position = {position[0], position[1], position[2]},
            .inverse_mass = ws_.inverse_mass.data(),
            .solid_density = ws_.solid_density.data(),
            .solid_gradient = {gradient[0], gradient[1], gradient[2]},
            .solid_gradient_square = solid_gradient_square_.data(),
            .density = ws_.density.data(),
            .lambda = lambda_.data(),
            .response = response_.data(),
            .lambda_sum = lambda_sum_.data(),
            .correction = {correction[0], correction[1], correction[2]},
            .velocity = {velocity[0], velocity[1], velocity[2]},
            .velocity_change = {correction[0], correction[1], correction[2]}};
}

/// A solid particle counts in the density of the fluid around it with weight solidPressure, like a fluid particle in
/// value and gradient; other than in scheme `flex` it takes the reaction, see push_solids_by_pressure.
template <class Real>
void ConservingStages<Real>::add_solid_pressure() {
    for (auto* array :
         {&ws_.solid_density, &solid_gradient_square_, &solid_gradient_.x, &solid_gradient_.y, &solid_gradient_.z})
        std::fill(array->begin(), array->end(), Real(0));
    const Real weight = static_cast<Real>(model_.parameters.solidPressure);
    for (std::size_t k = 0; k < ws_.touched.size() && ws_.touched[k] < ws_.fluid; ++k) {
        const int i = ws_.touched[k];
        Real sum = 0, square = 0;
        Vector3<Real> gradient = Vector3<Real>::Zero();
        for (int c = ws_.contact_begin[k]; c < ws_.contact_begin[k + 1]; ++c) {
            const int j = ws_.contact[c];
            const Vector3<Real> difference = position_of_slot(i) - position_of_slot(j);
            const Real r = difference.norm();
            const Real q = r * constants_.inverse_radius;
            if (q >= 1) continue;
            const Real poly = 1 - q * q;
            const Real slope = weight * gradient_scale_ * (1 - q) * (1 - q);
            sum += poly * poly * poly;
            if (r > 0) gradient -= slope / r * difference;
            square += ws_.inverse_mass[j] * slope * slope;
        }
        ws_.solid_density[i] = weight * kernel_scale_ * sum;
        solid_gradient_.set(i, gradient);
        solid_gradient_square_[i] = square;
    }
}

/// The solids' side of the density constraints: Dx_s = w_s sum over fluid i of lambda_i grad_s C_i.
template <class Real>
void ConservingStages<Real>::push_solids_by_pressure() {
    const Real weight = static_cast<Real>(model_.parameters.solidPressure);
    for (std::size_t k = 0; k < ws_.touched.size(); ++k) {
        const int s = ws_.touched[k];
        for (int c = ws_.contact_begin[k]; c < ws_.contact_begin[k + 1]; ++c) {
            const int other = ws_.contact[c];
            const bool solid_pushed = s >= ws_.solid_begin && other < ws_.fluid;
            const bool fluid_pushed = s < ws_.fluid && other >= ws_.solid_begin;
            if (!solid_pushed && !fluid_pushed) continue;
            const Vector3<Real> difference = position_of_slot(s) - position_of_slot(other);
            const Real r = difference.norm();
            const Real q = r * constants_.inverse_radius;
            if (q >= 1 || !(r > 0)) continue;
            const Real slope = weight * gradient_scale_ * (1 - q) * (1 - q);
            const Real lambda = lambda_[solid_pushed ? other : s];
            ws_.correction.add(s, -ws_.inverse_mass[s] * lambda * slope / r * difference);
        }
    }
}

template <class Real>
void ConservingStages<Real>::compute_lambda() {
    if (plan_.solid_pressure) add_solid_pressure();
    density_kernels_->compute_lambda(density_view());
}

/// Density constraint C_i = rho_i / rho0 - 1 <= 0 of Position Based Fluids (Macklin, Müller 2013) with inverse masses:
/// Dx_i = w_i / rho0 sum_j (lambda_i + lambda_j) / 2 grad W_ij. Sums of it over a pair are equal and opposite in m Dx.
template <class Real>
void ConservingStages<Real>::solve_density_constraint() {
    compute_lambda();
    density_kernels_->solve_density_constraint(density_view());
    if (plan_.solid_pressure) push_solids_by_pressure();
    for (int slot = 0; slot < ws_.fluid; ++slot) apply_correction(slot, pair_share<Real>);
    if (plan_.solid_pressure)
        for (const int slot : ws_.touched)
            if (slot >= ws_.solid_begin) apply_correction(slot, pair_share<Real>);
}

template DensityView<float> ConservingStages<float>::density_view();
template DensityView<double> ConservingStages<double>::density_view();
template void ConservingStages<float>::add_solid_pressure();
template void ConservingStages<double>::add_solid_pressure();
template void ConservingStages<float>::push_solids_by_pressure();
template void ConservingStages<double>::push_solids_by_pressure();
template void ConservingStages<float>::compute_lambda();
template void ConservingStages<double>::compute_lambda();
template void ConservingStages<float>::solve_density_constraint();
template void ConservingStages<double>::solve_density_constraint();

}  // namespace natator::cpu
