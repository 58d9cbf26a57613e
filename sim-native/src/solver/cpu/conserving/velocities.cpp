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

/// u = v* + displacement / h, which rounds less than a difference of positions; internal forces give their momentum
/// back; damping v / (1 + h damping).
template <class Real>
void ConservingStages<Real>::update_velocities() {
    if (water_) move_fluid();
    const Real kept = plan_.damping ? 1 / (1 + h_ * static_cast<Real>(model_.parameters.damping)) : Real(1);

    for (int i = 0; i < ws_.particles; ++i) new_velocity_[i] = present_velocity(i);
    keep_body_momentum();
    for (const FreeBody& body : bodies_) {
        for (const int i : body.particles) {
            const Vec3<double> arm = cast<double>(position_of_slot(ws_.slot_of[i])) - body.centre;
            new_velocity_[i] += cast<Real>(body.linear + cross(body.angular, arm));
        }
    }
    for (Vec3<Real>& v : new_velocity_) {
        v = kept * v;
        if (plan_.clamp_speed) v = clamped(v, constants_.max_speed);
    }
}

template void ConservingStages<float>::keep_body_momentum();
template void ConservingStages<double>::keep_body_momentum();
template void ConservingStages<float>::update_velocities();
template void ConservingStages<double>::update_velocities();

}  // namespace natator::cpu
