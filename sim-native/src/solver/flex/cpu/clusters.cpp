#include "flex_stages.h"
#include "physics/shape_matching.h"

namespace natator::cpu {

/// Plain mean and covariance, without masses; the rotation starts from the last fit.
template <class Real>
void FlexStages<Real>::solve_clusters() {
    for (std::size_t k = 0; k < model_.clusters.size(); ++k) {
        const std::vector<int>& members = model_.clusters[k].particles;
        const std::vector<Vec3<Real>>& offsets = cluster_offset_[k];

        Vec3<double> sum{};
        for (const int i : members) sum += cast<double>(position_of_slot(ws_.slot_of[i]));
        const Vec3<Real> mean = cast<Real>(sum / static_cast<double>(members.size()));

        physics::Covariance covariance;
        for (std::size_t m = 0; m < members.size(); ++m)
            add_arm(covariance, position_of_slot(ws_.slot_of[members[m]]) - mean, offsets[m]);
        Eigen::Quaterniond rotation = cluster_rotation_[k].template cast<double>();
        physics::fit_rotation(covariance, rotation.coeffs().data());
        cluster_rotation_[k] = rotation.template cast<Real>();
        cluster_centre_[k] = with_dead_band(cluster_centre_[k], mean);

        Real matrix[9];
        physics::rotation_matrix(cluster_rotation_[k].coeffs().data(), matrix);
        const Real stiffness = static_cast<Real>(model_.clusters[k].stiffness);
        for (std::size_t m = 0; m < members.size(); ++m) {
            const int slot = ws_.slot_of[members[m]];
            add_correction(slot,
                           goal_correction(stiffness, cluster_centre_[k], matrix, offsets[m], position_of_slot(slot)));
        }
    }
}

template void FlexStages<float>::solve_clusters();
template void FlexStages<double>::solve_clusters();

}  // namespace natator::cpu
