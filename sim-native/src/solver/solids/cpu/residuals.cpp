#include "conserving_stages.h"
#include "physics/shape_matching.h"
#include "solver/cpu/residual_sum.h"

namespace natator::cpu {

/// The water's velocities are those of the solids by now, as in the next pass.
template <class Real>
void ConservingStages<Real>::measure_constraints(Residuals& residuals) {
    if (water_) {
        send_velocities_to_water();
        water_->update_ghost_velocities(*this->team_);
        residuals.density = water_->measure_target_residual(*this->team_);
    }
    ResidualSum springs, clusters;
    for (std::size_t s = 0; s < model_.springs.size(); ++s) {
        const Spring& spring = model_.springs[s];
        const Real weights = inverse_mass_[spring.a] + inverse_mass_[spring.b], rest = state_->spring_rest_length[s];
        const Real alpha = spring_compliance(spring_rules_[s], weights, h_);
        if (!(weights > 0 && std::isfinite(alpha))) continue;
        const Real length = norm(position_of_slot(ws_.slot_of[spring.a]) - position_of_slot(ws_.slot_of[spring.b]));
        springs.add((length - rest + alpha * spring_lambda_[s]) / rest);
    }
    for (std::size_t k = 0; k < model_.clusters.size(); ++k) {
        const double alpha = physics::relative_compliance(physics::softness(model_.clusters[k].stiffness), h_);
        if (!std::isfinite(alpha)) continue;
        Real matrix[9];
        physics::rotation_matrix(cluster_rotation_[k].coeffs().data(), matrix);
        for (std::size_t m = 0; m < model_.clusters[k].particles.size(); ++m) {
            const Vec3<Real> x = position_of_slot(ws_.slot_of[model_.clusters[k].particles[m]]);
            const Vec3<Real> away = way_to_goal(cluster_centre_[k], matrix, cluster_offset_[k][m], x);
            clusters.add(norm(away - static_cast<Real>(alpha) * member_displacement_[k][m]) / constants_.radius);
        }
    }
    residuals.springs = springs.residual();
    residuals.clusters = clusters.residual();
}

template void ConservingStages<float>::measure_constraints(Residuals&);
template void ConservingStages<double>::measure_constraints(Residuals&);

}  // namespace natator::cpu
