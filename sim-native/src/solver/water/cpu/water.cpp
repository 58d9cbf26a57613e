#include "water.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "model/background_pressure.h"
#include "model/boundaries.h"
#include "model/water_volumes.h"
#include "physics/constants.h"
#include "physics/dfsph.h"
#include "solver/cpu/residual_sum.h"
#include "solver/cpu/workspace.h"

namespace natator::cpu {

template <class Real>
Water<Real>::Water(const Model& model)
    : model_(model),
      kernels_(&water_kernels<Real>(instruction_set())),
      neighbour_kernels_(&neighbour_kernels<Real>(instruction_set())),
      radius_(static_cast<Real>(support(model))),
      spacing_(static_cast<Real>(model.parameters.fluid_rest_distance)),
      kernel_scale_(static_cast<Real>(wendland(0, support(model)))),
      at_spacing_(static_cast<Real>(1 / wendland(model.parameters.fluid_rest_distance, support(model)))),
      ghosts_(model),
      periodic_axes_(periodic_axes_of<Real>(model)),
      particles_(model.particles()),
      ghost_begin_(round_up_to_block(model.particles())) {
    effect_radius_ = static_cast<Real>(effect_radius(model));
    fluid_gravity_ = vec3<Real>((model.parameters.buoyancy * model.parameters.gravity).template cast<Real>().eval());
    weight_on_walls_ = vec3<Real>((model.parameters.buoyancy * gravity_on_walls(model)).template cast<Real>().eval());
    carried_ = background_pressure<Real>(model);
    max_expansion_rate_ = static_cast<Real>(max_expansion_rate(model.parameters, solved_depth(model)));
    const std::vector<double> volumes = particle_volumes(model);
    const double density = fluid_density(model, volumes);
    fluid_density_ = static_cast<Real>(density);
    dynamic_viscosity_ = static_cast<Real>(model.parameters.conserving.kinematic_viscosity * density);
    for (const double v : volumes) volume_of_.push_back(static_cast<Real>(v));
    for (const double w : model.inverse_mass) inverse_mass_of_.push_back(static_cast<Real>(w));
    for (int i = 0; i < particles_; ++i)
        mobility_of_.push_back(static_cast<Real>(physics::mobility(model.inverse_mass[i], volumes[i], density)));
    slot_of_.resize(particles_);
    cell_of_.resize(particles_);
    particle_of_.assign(ghost_begin_, -1);
    row_begin_.assign(ghost_begin_ / lanes + 1, 0);
    neighbour_count_.assign(ghost_begin_, 0);
    for (auto* array :
         {&solid_, &density_, &max_speed_square_, &response_, &target_, &impulse_sum_, &zeroth_order_correction_})
        array->resize(ghost_begin_);
    for (auto& array : correction_) array.resize(ghost_begin_);
    crowding_.resize(ghost_begin_);
    zeroth_.resize(ghost_begin_);
}

template <class Real>
Vec3<Real> Water<Real>::shift(int particle) const {
    const int slot = slot_of_[particle];
    const Vec3<Real> separation = separation_.empty() ? Vec3<Real>{} : separation_[slot];
    if (!model_.is_fluid(particle)) return separation;
    return separation +
           physics::shift_of(density_[slot], crowding_.at(slot), max_speed_square_[slot], radius_, spacing_, h_);
}

/// Where particles start too close, see physics::separation_target. Bodies stay where they are, as pushing their
/// particles would bend them.
template <class Real>
bool Water<Real>::begin_overlap_separation(ThreadTeam& team) {
    separation_.clear();
    const Real limit = physics::velocity_limit(h_, max_expansion_rate_);
    std::atomic<bool> any = false;
    team.for_parts(particles_, min_run, [&, h = h_](int, int begin, int end) {
        const Real *const volume = volume_.data(), *const density = density_.data();
        Real* const target = target_.data();
        Real densest = 0;
        for (int slot = begin; slot < end; ++slot) {
            densest = std::max(densest, density[slot]);
            target[slot] = physics::separation_target(volume[slot], density[slot], limit, h);
        }
        if (densest - 1 > Real(physics::overlap_tolerance)) any = true;
    });
    if (!any) return false;
    kept_velocity_ = velocity_;
    for_each_slot(team, [this](int slot) {
        velocity_.set(slot, {});
        if (!model_.is_fluid(particle_of_[slot])) inverse_mass_[slot] = 0;
    });
    on_all_threads(team, kernels_->pack);
    update_ghost_velocities(team);
    return true;
}

template <class Real>
void Water<Real>::separate_overlaps(ThreadTeam& team) {
    compute_impulses(team);
    apply_impulses(team);
    update_ghost_velocities(team);
}

template <class Real>
void Water<Real>::end_overlap_separation(ThreadTeam& team) {
    separation_.resize(particles_);
    for_each_slot(team, [this](int slot) {
        separation_[slot] = clamped(h_ * velocity_.at(slot), Real(physics::max_separation) * spacing_);
        velocity_.set(slot, kept_velocity_.at(slot));
        inverse_mass_[slot] = inverse_mass_of_[particle_of_[slot]];
    });
    on_all_threads(team, kernels_->pack);
    update_ghost_velocities(team);
}

template <class Real>
void Water<Real>::update_ghost_corrections(ThreadTeam& team) {
    for_each_ghost(team, [this](int k) {
        const int owner = ghost_owner_[k];
        const auto part = [&](int c) { return correction_[c][owner]; };
        Eigen::Matrix<Real, 3, 3> l;
        l << part(0), part(3), part(4), part(3), part(1), part(5), part(4), part(5), part(2);
        const auto& h = ghosts_.matrix(ghost_transform_[k]);
        l = (h * l * h.transpose()).eval();
        const std::size_t slot = 4 * static_cast<std::size_t>(ghost_begin_ + k);
        const Real packed[8] = {l(0, 0), l(1, 1), l(2, 2), l(0, 1), l(0, 2), l(1, 2), solid_[owner], 0};
        std::copy_n(packed, 4, packed_correction_.begin() + static_cast<std::ptrdiff_t>(slot));
        std::copy_n(packed + 4, 4, packed_shear_.begin() + static_cast<std::ptrdiff_t>(slot));
    });
    for (auto* array : {&packed_correction_, &packed_shear_})
        std::fill_n(array->begin() + 4 * static_cast<std::ptrdiff_t>(far_slot_), 4, Real(0));
}

template <class Real>
void Water<Real>::update_ghosts(AlignedVector<Real>& packed, ThreadTeam& team) {
    using Vector = Eigen::Matrix<Real, 3, 1>;
    for_each_ghost(team, [&](int k) {
        const Vector v = ghosts_.matrix(ghost_transform_[k]) *
                         Eigen::Map<const Vector>(&packed[4 * static_cast<std::size_t>(ghost_owner_[k])]);
        std::copy_n(v.data(), 3, packed.begin() + 4 * static_cast<std::ptrdiff_t>(ghost_begin_ + k));
    });
}

template <class Real>
void Water<Real>::update_ghost_velocities(ThreadTeam& team) {
    update_ghosts(packed_velocity_, team);
}

template <class Real>
WaterView<Real> Water<Real>::view() {
    const auto pointers = [](Vector3Array<Real>& array) { return array.pointers(); };
    const auto position = pointers(position_), velocity = pointers(velocity_), crowding = pointers(crowding_),
               gradient = pointers(gradient_), zeroth = pointers(zeroth_);
    const physics::WendlandKernel<Real> kernel = physics::wendland_kernel(radius_, kernel_scale_);
    WaterView<Real> all{.first_block = 0,
                        .end_block = ghost_begin_ / lanes,
                        .row_begin = row_begin_.data(),
                        .neighbour = neighbour_.data(),
                        .far_slot = far_slot_,
                        .inverse_radius = kernel.inverse_radius,
                        .kernel_scale = kernel.scale,
                        .slope_scale = kernel.slope_scale,
                        .at_spacing = at_spacing_,
                        .softening = physics::viscous_softening(spacing_),
                        .position = {position[0], position[1], position[2]},
                        .volume = volume_.data(),
                        .inverse_mass = inverse_mass_.data(),
                        .mobility = mobility_.data(),
                        .solid = solid_.data(),
                        .velocity = {velocity[0], velocity[1], velocity[2]},
                        .density = density_.data(),
                        .correction = {},
                        .crowding = {crowding[0], crowding[1], crowding[2]},
                        .max_speed_square = max_speed_square_.data(),
                        .response = response_.data(),
                        .target = target_.data(),
                        .impulse = impulse_.data(),
                        .impulse_sum = impulse_sum_.data(),
                        .zeroth = {zeroth[0], zeroth[1], zeroth[2]},
                        .zeroth_order_correction = zeroth_order_correction_.data(),
                        .packed = packed_.data(),
                        .packed_velocity = packed_velocity_.data(),
                        .packed_correction = packed_correction_.data(),
                        .packed_shear = packed_shear_.data(),
                        .packed_zeroth_order = packed_zeroth_order_.data(),
                        .distance = distance_.data(),
                        .gradient = {gradient[0], gradient[1], gradient[2]}};
    for (int k = 0; k < 6; ++k) all.correction[k] = correction_[k].data();
    return all;
}

template <class Real>
void Water<Real>::compute_impulses(ThreadTeam& team) {
    on_all_threads(team, kernels_->compute_impulse);
}

template <class Real>
Residual Water<Real>::target_residual() const {
    ResidualSum sum;
    for (int slot = 0; slot < particles_; ++slot) {
        if (!model_.is_fluid(particle_of_[slot])) continue;
        const Real rate =
            impulse_[slot] > 0 ? impulse_[slot] / (Real(physics::jacobi_relaxation) * response_[slot]) : Real(0);
        sum.add(rate * h_ / volume_[slot]);
    }
    return sum.residual();
}

template <class Real>
Residual Water<Real>::measure_target_residual(ThreadTeam& team) {
    const AlignedVector<Real> sum = impulse_sum_;
    compute_impulses(team);
    impulse_sum_ = sum;
    return target_residual();
}

template <class Real>
void Water<Real>::apply_impulses(ThreadTeam& team) {
    for_each_ghost(team, [this](int k) { impulse_[ghost_begin_ + k] = impulse_[ghost_owner_[k]]; });
    on_all_threads(team, kernels_->apply_impulse);
}

template <class Real>
void Water<Real>::apply_corrected_impulses(ThreadTeam& team) {
    apply_impulses(team);
    const Real strength = physics::uncorrected_strength(h_, fluid_density_);
    on_all_threads(team, [&](const WaterView<Real>& part) { kernels_->apply_zeroth_order_correction(part, strength); });
    update_ghost_velocities(team);
}

template <class Real>
void Water<Real>::return_zeroth_order_correction(ThreadTeam& team) {
    on_all_threads(team, kernels_->lay_out_zeroth_order_correction);
    update_ghosts(packed_zeroth_order_, team);
    std::fill_n(packed_zeroth_order_.begin() + 4 * static_cast<std::ptrdiff_t>(far_slot_), 4, Real(0));
    on_all_threads(team, kernels_->return_zeroth_order_correction);
}

template <class Real>
void Water<Real>::compute_gradients(ThreadTeam& team) {
    on_all_threads(team, kernels_->compute_moments);
    update_ghost_corrections(team);
    on_all_threads(team, kernels_->compute_gradients);
}

template <class Real>
void Water<Real>::solve_divergence(ThreadTeam& team) {
    std::fill(zeroth_order_correction_.begin(), zeroth_order_correction_.end(), Real(0));
    std::fill(target_.begin(), target_.end(), Real(0));
    if (!separation_.empty()) {
        std::fill(impulse_sum_.begin(), impulse_sum_.end(), Real(0));
        compute_impulses(team);
    }  // else compute_gradients has computed them
    apply_corrected_impulses(team);
}

template <class Real>
void Water<Real>::add_viscosity(ThreadTeam& team) {
    if (!(dynamic_viscosity_ > 0)) return;
    const Real strength = physics::viscous_strength(h_, dynamic_viscosity_);
    const Real limit = physics::viscous_limit(spacing_, strength);
    add_viscous_forces(strength, limit);
    on_all_threads(team, [&](const WaterView<Real>& part) { kernels_->add_viscosity(part, strength, limit); });
}

template <class Real>
void Water<Real>::add_gravity(ThreadTeam& team) {
    const Real limit = physics::velocity_limit(h_, max_expansion_rate_);
    const Vec3<Real> gravity = vec3<Real>(model_.parameters.gravity.template cast<Real>());
    const auto acceleration = [&](int slot) {
        const bool fluid = model_.is_fluid(particle_of_[slot]);
        const Vec3<Real> all = fluid ? fluid_gravity_ : gravity;
        if (!carried_.any()) return all;
        return all -
               carried_.acceleration(position_.at(slot), fluid, fluid_density_, volume_[slot], inverse_mass_[slot]);
    };
    for_each_slot(team, [&](int slot) {
        if (inverse_mass_[slot] > 0) velocity_.add(slot, h_ * acceleration(slot));
        target_[slot] = physics::density_target(volume_[slot], density_[slot], limit, h_);
    });
    on_all_threads(team, kernels_->pack);
    update_ghost_velocities(team);
}

template <class Real>
void Water<Real>::apply_wall_pressure(ThreadTeam& team) {
    if (ghost_owner_.empty() || !(norm(weight_on_walls_) > 0)) return;
    std::fill_n(impulse_.begin(), ghost_begin_, Real(0));
    const auto weight = [this](int owner) {
        if (!carried_.any()) return weight_on_walls_;
        return weight_on_walls_ - carried_.part(position_.at(owner)) * carried_.gravity;
    };
    for_each_ghost(team, [&](int k) {
        const int slot = ghost_begin_ + k, owner = ghost_owner_[k];
        impulse_[slot] = is_fluid_slot(owner) ? physics::hydrostatic_ghost_impulse(
                                                    inverse_mass_[owner], volume_[owner], h_, weight(owner),
                                                    position_.at(slot) - position_.at(owner), impulse_sum_[owner])
                                              : Real(0);
    });
    const auto at_wall = [this](int block) {
        for (int slot = block * lanes; slot < std::min((block + 1) * lanes, particles_); ++slot)
            if (ghosts_.reaches_walls(eigen(position_.at(slot)), radius_)) return true;
        return false;
    };
    on_all_threads(team, [&](WaterView<Real> part) {
        for (const int end = part.end_block; part.first_block < end; ++part.first_block) {
            part.end_block = part.first_block + 1;
            if (at_wall(part.first_block)) kernels_->apply_impulse(part);
        }
    });
}

template class Water<float>;
template class Water<double>;

}  // namespace natator::cpu
