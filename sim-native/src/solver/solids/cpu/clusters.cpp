#include <cmath>

#include "conserving_stages.h"
#include "physics/shape_matching.h"
#include "physics/spring.h"

namespace natator::cpu {

/// With the masses m_j / n_j, n_j = clusters of particle j, so that each cluster alone keeps its momentum; a particle
/// goes to the average of its clusters' goals.
template <class Real>
void ConservingStages<Real>::solve_clusters() {
    for (std::size_t k = 0; k < model_.clusters.size(); ++k) {
        const double compliance = physics::relative_compliance(physics::softness(model_.clusters[k].stiffness), h_);
        if (!std::isfinite(compliance)) continue;
        const Real alpha = static_cast<Real>(compliance);
        const std::vector<int>& members = model_.clusters[k].particles;
        const std::vector<Vec3<Real>>& offsets = cluster_offset_[k];
        const std::vector<Real>& masses = member_mass_[k];
        const auto place = [&](std::size_t m) { return cast<double>(position_of_slot(ws_.slot_of[members[m]])); };

        Vec3<double> sum{};
        double total = 0;
        for (std::size_t m = 0; m < members.size(); ++m) {
            sum += static_cast<double>(masses[m]) * place(m);
            total += static_cast<double>(masses[m]);
        }
        const Vec3<double> centre = sum / total;

        physics::Covariance covariance;
        for (std::size_t m = 0; m < members.size(); ++m)
            add_arm(covariance, static_cast<double>(masses[m]), place(m) - centre, cast<double>(offsets[m]));
        Eigen::Quaterniond rotation = cluster_rotation_[k].template cast<double>();
        physics::closest_rotation(covariance, rotation.coeffs().data());
        cluster_rotation_[k] = rotation.template cast<Real>();
        cluster_centre_[k] = cast<Real>(centre);

        double matrix[9];
        physics::rotation_matrix(rotation.coeffs().data(), matrix);
        for (std::size_t m = 0; m < members.size(); ++m) {
            const int slot = ws_.slot_of[members[m]];
            const Vec3<Real> change = compliant_goal_change(centre, matrix, offsets[m], position_of_slot(slot), alpha,
                                                            member_displacement_[k][m]);
            ws_.correction.add(slot, masses[m] * ws_.inverse_mass[slot] * change);
        }
    }
    apply_internal_corrections();
}

template void ConservingStages<float>::solve_clusters();
template void ConservingStages<double>::solve_clusters();

}  // namespace natator::cpu
