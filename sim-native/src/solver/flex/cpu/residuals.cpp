#include "flex_stages.h"
#include "physics/shape_matching.h"
#include "solver/cpu/residual_sum.h"

namespace natator::cpu {

template <class Real>
void FlexStages<Real>::measure_constraints(Residuals& residuals) {
    ResidualSum density, springs, clusters;
    const std::vector<Real> densities = this->densities_by_particle();
    for (const int i : ws_.fluid_ids) density.add(std::max(densities[i] - 1, Real(0)));
    for (std::size_t s = 0; s < model_.springs.size(); ++s) {
        const Spring& spring = model_.springs[s];
        const Real rest = state_->spring_rest_length[s];
        springs.add((norm(position_of_slot(ws_.slot_of[spring.a]) - position_of_slot(ws_.slot_of[spring.b])) - rest) /
                    rest);
    }
    for (std::size_t k = 0; k < model_.clusters.size(); ++k) {
        Real matrix[9];
        physics::rotation_matrix(cluster_rotation_[k].coeffs().data(), matrix);
        for (std::size_t m = 0; m < model_.clusters[k].particles.size(); ++m) {
            const Vec3<Real> x = position_of_slot(ws_.slot_of[model_.clusters[k].particles[m]]);
            clusters.add(norm(way_to_goal(cluster_centre_[k], matrix, cluster_offset_[k][m], x)) / constants_.radius);
        }
    }
    residuals.density = density.residual();
    residuals.springs = springs.residual();
    residuals.clusters = clusters.residual();
}

template void FlexStages<float>::measure_constraints(Residuals&);
template void FlexStages<double>::measure_constraints(Residuals&);

}  // namespace natator::cpu
