#include "conserving_stages.h"

namespace natator::cpu {

/// What the displacements by springs and clusters did to a free body's momentum, to be given back: these forces are
/// internal. With x1 = x0 + h v1 the angular momentum after the substep is sum of m x0 x v1, so they must have no
/// moment about the start positions: sum of m x0 x Dx = 0. Position corrections have none about the positions they
/// were computed at, which leaves an error of first order in h. It is given back as a rigid rotation of the velocities,
/// as momentum is in Dinev et al.: FEPR: Fast Energy Projection for Real-Time Simulation of Deformable Objects (2018).
template <class Real>
void ConservingStages<Real>::keep_body_momentum() {
    for (FreeBody& body : bodies_) {
        double total = 0;
        Vec3<double> start_centre{};
        body.centre = {};
        for (const int i : body.particles) {
            const double mass = 1 / static_cast<double>(inverse_mass_[i]);
            total += mass;
            start_centre += mass * cast<double>(vec3(state_->position[i]));
            body.centre += mass * cast<double>(position_of_slot(ws_.slot_of[i]));
        }
        start_centre = start_centre / total;
        body.centre = body.centre / total;

        Vec3<double> momentum{}, moment{};
        Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
        for (const int i : body.particles) {
            const double mass = 1 / static_cast<double>(inverse_mass_[i]);
            const Vec3<double> impulse = mass / static_cast<double>(h_) * cast<double>(internal_[i]);
            momentum += impulse;
            moment += cross(cast<double>(vec3(state_->position[i])) - start_centre, impulse);
            const Eigen::Vector3d arm = eigen(cast<double>(position_of_slot(ws_.slot_of[i])) - body.centre);
            inertia += mass * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
        }
        body.linear = -1 / total * momentum;
        // A straight chain has no inertia about its own axis, and no moment either: least-norm solution.
        body.angular = vec3<double>(-inertia.completeOrthogonalDecomposition().solve(eigen(moment)));
    }
}

/// Takes the rate of change of the density to 0 where the fluid is under pressure, as an inelastic contact does:
/// pushing particles apart must not leave them flying apart. Pairwise and along their lines, so momenta are kept; what
/// it takes away is kinetic energy.
template <class Real>
void ConservingStages<Real>::solve_density_rate() {
    for (const int i : ws_.fluid_ids) ws_.velocity.set(ws_.slot_of[i], this->new_velocity_[i]);
    const DensityView<Real> fluid = density_view();
    this->on_all_threads(fluid, density_kernels_->pack);
    this->on_all_threads(fluid, density_kernels_->pack_velocity);
    this->on_all_threads(
        fluid, [this](const DensityView<Real>& part) { density_kernels_->compute_rate_lambda(part, 1 / h_); });
    for (int slot = 0; slot < ws_.fluid; ++slot) lambda_sum_[slot] += h_ * lambda_[slot];
    solve_density_constraint_of_fluid();
    for (const int i : ws_.fluid_ids) this->new_velocity_[i] += pair_share<Real> * ws_.correction.at(ws_.slot_of[i]);
}

/// u = v* + displacement / h, which rounds less than a difference of positions; internal forces give their momentum
/// back; viscosity exchanges momentum within pairs, so it needs no masses to be equal; damping v / (1 + h damping).
template <class Real>
void ConservingStages<Real>::update_velocities() {
    const Real viscosity = static_cast<Real>(model_.parameters.viscosity);
    // At most half of a velocity difference is taken off in a substep, however large the viscosity.
    const Real smoothing = h_ * viscosity / (1 + 2 * h_ * viscosity);
    const Real kept = plan_.damping ? 1 / (1 + h_ * static_cast<Real>(model_.parameters.damping)) : Real(1);

    for (int i = 0; i < ws_.particles; ++i) {
        const int slot = ws_.slot_of[i];
        this->new_velocity_[i] = ws_.predicted.at(slot) + 1 / h_ * displacement_.at(slot);
    }
    keep_body_momentum();
    for (const FreeBody& body : bodies_) {
        for (const int i : body.particles) {
            const Vec3<double> arm = cast<double>(position_of_slot(ws_.slot_of[i])) - body.centre;
            this->new_velocity_[i] += cast<Real>(body.linear + cross(body.angular, arm));
        }
    }
    if (plan_.fluid) solve_density_rate();
    if (plan_.viscosity) {
        for (const int i : ws_.fluid_ids) ws_.velocity.set(ws_.slot_of[i], this->new_velocity_[i]);
        const DensityView<Real> fluid = density_view();
        this->on_all_threads(fluid, density_kernels_->pack);
        this->on_all_threads(fluid, density_kernels_->pack_velocity);
        this->on_all_threads(fluid, density_kernels_->smooth_velocities);
        for (const int i : ws_.fluid_ids) this->new_velocity_[i] += smoothing * ws_.correction.at(ws_.slot_of[i]);
    }
    for (Vec3<Real>& v : this->new_velocity_) {
        v = kept * v;
        if (plan_.clamp_speed) v = clamped(v, constants_.max_speed);
    }
}

template void ConservingStages<float>::keep_body_momentum();
template void ConservingStages<double>::keep_body_momentum();
template void ConservingStages<float>::update_velocities();
template void ConservingStages<double>::update_velocities();

}  // namespace natator::cpu
