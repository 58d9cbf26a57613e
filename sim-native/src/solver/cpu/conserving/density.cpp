#include <algorithm>
#include <cmath>
#include <numbers>

#include "conserving_stages.h"

namespace natator::cpu {

template <class Real>
DensityView<Real> ConservingStages<Real>::density_view() {
    const auto position = ws_.position.pointers();
    const auto correction = ws_.correction.pointers();
    const auto velocity = ws_.velocity.pointers();
    const auto gradient = solid_gradient_.pointers();
    return {.first_block = 0,
            .end_block = ws_.blocks(),
            .row_begin = ws_.row_begin.data(),
            .neighbour = ws_.neighbour.data(),
            .far_slot = ws_.slots,
            .inverse_radius = constants_.inverse_radius,
            .kernel_scale = own_.kernel_scale,
            .rest_sum = own_.rest_sum,
            .gradient_scale = own_.gradient_scale,
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
            .velocity_change = {correction[0], correction[1], correction[2]},
            .packed = ws_.packed.data(),
            .packed_velocity = ws_.packed_velocity.data(),
            .inverse_distance = ws_.distance.empty() ? nullptr : ws_.distance.data()};
}

template <class Real>
void ConservingStages<Real>::clear_boundary_terms() {
    for (auto* array :
         {&ws_.solid_density, &solid_gradient_square_, &solid_gradient_.x, &solid_gradient_.y, &solid_gradient_.z})
        std::fill(array->begin(), array->end(), Real(0));
}

template <class Real>
PlanePressure<Real> ConservingStages<Real>::plane_pressure() {
    const auto position = ws_.position.pointers(), gradient = solid_gradient_.pointers(),
               correction = ws_.correction.pointers();
    return {.position = {position[0], position[1], position[2]},
            .scale = own_.plane_scale,
            .gap = own_.plane_gap,
            .inverse_radius = constants_.inverse_radius,
            .density = ws_.solid_density.data(),
            .gradient = {gradient[0], gradient[1], gradient[2]},
            .inverse_mass = ws_.inverse_mass.data(),
            .lambda = lambda_.data(),
            .correction = {correction[0], correction[1], correction[2]}};
}

template <class Real>
void ConservingStages<Real>::add_plane_pressure() {
    const PlanePressure<Real> fluid = plane_pressure();
    this->for_each_plane_group(ws_.blocks(), [&](int block, unsigned chosen, const PlaneView<Real>& plane) {
        this->plane_kernels_->add_density(fluid, block, chosen, plane);
    });
}

template <class Real>
void ConservingStages<Real>::add_solid_pressure() {
    const Real weight = static_cast<Real>(model_.parameters.solidPressure);
    for (std::size_t k = 0; k < ws_.touched.size() && ws_.touched[k] < ws_.fluid; ++k) {
        const int i = ws_.touched[k];
        physics::Boundary<Real> boundary;
        for (int c = ws_.contact_begin[k]; c < ws_.contact_begin[k + 1]; ++c) {
            const int j = ws_.contact[c];
            add_solid(boundary, position_of_slot(i) - position_of_slot(j), constants_.inverse_radius, weight,
                      fluid_kernel(), ws_.inverse_mass[j]);
        }
        ws_.solid_density[i] += boundary.density;
        solid_gradient_.add(i, boundary.gradient);
        solid_gradient_square_[i] += boundary.square;
    }
}

/// The solids' side of the density constraints: Dx_s = w_s sum over fluid i of lambda_i grad_s C_i.
template <class Real>
void ConservingStages<Real>::push_solids_by_pressure() {
    const Real scale = static_cast<Real>(model_.parameters.solidPressure) * own_.gradient_scale;
    for (std::size_t k = 0; k < ws_.touched.size(); ++k) {
        const int s = ws_.touched[k];
        for (int c = ws_.contact_begin[k]; c < ws_.contact_begin[k + 1]; ++c) {
            const int other = ws_.contact[c];
            const bool solid_pushed = s >= ws_.solid_begin && other < ws_.fluid;
            const bool fluid_pushed = s < ws_.fluid && other >= ws_.solid_begin;
            if (!solid_pushed && !fluid_pushed) continue;
            const Real lambda = lambda_[solid_pushed ? other : s];
            ws_.correction.add(s, ws_.inverse_mass[s] *
                                      physics::solid_pressure_push(position_of_slot(s) - position_of_slot(other),
                                                                   constants_.inverse_radius, scale, lambda));
        }
    }
}

template <class Real>
void ConservingStages<Real>::push_from_planes() {
    const PlanePressure<Real> fluid = plane_pressure();
    this->for_each_plane_group(ws_.blocks(), [&](int block, unsigned chosen, const PlaneView<Real>& plane) {
        this->plane_kernels_->apply_pressure(fluid, block, chosen, plane);
    });
}

template <class Real>
void ConservingStages<Real>::compute_lambda_of_fluid(const DensityView<Real>& fluid) {
    this->on_all_threads(fluid, density_kernels_->pack);
    this->on_all_threads(fluid, density_kernels_->compute_lambda);
}

template <class Real>
void ConservingStages<Real>::solve_density_constraint_of_fluid() {
    const DensityView<Real> fluid = density_view();
    this->on_all_threads(fluid, density_kernels_->pack_lambda);
    this->on_all_threads(fluid, density_kernels_->solve_density_constraint);
}

template <class Real>
void ConservingStages<Real>::compute_lambda() {
    if (plan_.solid_pressure || plan_.planes) clear_boundary_terms();
    if (plan_.planes) add_plane_pressure();
    if (plan_.solid_pressure) add_solid_pressure();
    compute_lambda_of_fluid(density_view());
}

template <class Real>
void ConservingStages<Real>::solve_density_constraint() {
    compute_lambda();
    if (!looked_for_overlap_) {
        looked_for_overlap_ = true;
        overlapping_ = find_overlap();
    }
    if (overlapping_) limit_overlap_pressure();
    solve_density_constraint_of_fluid();
    if (plan_.planes) push_from_planes();
    if (plan_.solid_pressure) push_solids_by_pressure();
    for (int slot = 0; slot < ws_.fluid; ++slot) apply_correction(slot, pair_share<Real>);
    if (plan_.solid_pressure)
        for (const int slot : ws_.touched)
            if (slot >= ws_.solid_begin) apply_correction(slot, pair_share<Real>);
}

/// The virial of particle i's density constraint: p_i = -lambda_i / h^2 n0 / 3 sum_j r_ij |grad_j C_i|.
template <class Real>
std::vector<Real> ConservingStages<Real>::pressures() const {
    std::vector<Real> pressures(ws_.particles, Real(0));
    if (!plan_.fluid) return pressures;
    const double at_rest = std::numbers::sqrt2 / std::pow(model_.parameters.fluidRestDistance, 3);
    const Real scale = constants_.relaxation_factor * pair_share<Real> * static_cast<Real>(at_rest) / (3 * h_ * h_);
    for (const int i : ws_.fluid_ids) {
        const int slot = ws_.slot_of[i];
        const int block = slot / lanes;
        Real virial = 0;
        for (int row = ws_.row_begin[block]; row < ws_.row_begin[block + 1]; ++row) {
            const int j = ws_.neighbour[row * lanes + slot % lanes];
            const Real r = norm(position_of_slot(slot) - position_of_slot(j));
            virial += own_.gradient_scale * physics::positive_square(1 - r * constants_.inverse_radius) * r;
        }
        pressures[i] = -scale * lambda_sum_[slot] * virial;
    }
    return pressures;
}

template std::vector<float> ConservingStages<float>::pressures() const;
template std::vector<double> ConservingStages<double>::pressures() const;
template DensityView<float> ConservingStages<float>::density_view();
template DensityView<double> ConservingStages<double>::density_view();
template void ConservingStages<float>::clear_boundary_terms();
template void ConservingStages<double>::clear_boundary_terms();
template void ConservingStages<float>::add_plane_pressure();
template void ConservingStages<double>::add_plane_pressure();
template void ConservingStages<float>::push_from_planes();
template void ConservingStages<double>::push_from_planes();
template void ConservingStages<float>::add_solid_pressure();
template void ConservingStages<double>::add_solid_pressure();
template void ConservingStages<float>::push_solids_by_pressure();
template void ConservingStages<double>::push_solids_by_pressure();
template void ConservingStages<float>::compute_lambda_of_fluid(const DensityView<float>&);
template void ConservingStages<double>::compute_lambda_of_fluid(const DensityView<double>&);
template void ConservingStages<float>::solve_density_constraint_of_fluid();
template void ConservingStages<double>::solve_density_constraint_of_fluid();
template void ConservingStages<float>::compute_lambda();
template void ConservingStages<double>::compute_lambda();
template void ConservingStages<float>::solve_density_constraint();
template void ConservingStages<double>::solve_density_constraint();

}  // namespace natator::cpu
