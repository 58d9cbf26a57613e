#include "../rotation_fit.h"
#include "flex_stages.h"

namespace natator::cpu {
namespace {

constexpr int rotation_fit_steps = 4;

/// A component of the stored centre takes the new mean only where the two differ by more than this.
constexpr double centre_dead_band = 1e-5;

}  // namespace

/// Shape matching: Dx_j = k (c + R r_j - x_j), r_j = rest position minus mean of the rest positions. Plain mean and
/// covariance, without masses; R starts from the last fit; the centre c has a dead band.
template <class Real>
void FlexStages<Real>::solve_clusters() {
    for (std::size_t k = 0; k < model_.clusters.size(); ++k) {
        const std::vector<int>& members = model_.clusters[k].particles;
        const std::vector<Vector3<Real>>& offsets = cluster_offset_[k];

        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const int i : members) sum += position_of_slot(ws_.slot_of[i]).template cast<double>();
        const Vector3<Real> mean = (sum / static_cast<double>(members.size())).template cast<Real>();

        Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
        for (std::size_t m = 0; m < members.size(); ++m) {
            const Vector3<Real> arm = position_of_slot(ws_.slot_of[members[m]]) - mean;
            covariance += (arm * offsets[m].transpose()).template cast<double>();
        }
        Eigen::Quaterniond rotation = cluster_rotation_[k].template cast<double>();
        fit_rotation(covariance, rotation, rotation_fit_steps);
        cluster_rotation_[k] = rotation.template cast<Real>();

        Vector3<Real>& centre = cluster_centre_[k];
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(mean[axis] - centre[axis]) > Real(centre_dead_band)) centre[axis] = mean[axis];

        const Real stiffness = static_cast<Real>(model_.clusters[k].stiffness);
        const Eigen::Matrix<Real, 3, 3> matrix = cluster_rotation_[k].toRotationMatrix();
        for (std::size_t m = 0; m < members.size(); ++m) {
            const int slot = ws_.slot_of[members[m]];
            add_correction(slot, stiffness * (centre + matrix * offsets[m] - position_of_slot(slot)));
        }
    }
}

template void FlexStages<float>::solve_clusters();
template void FlexStages<double>::solve_clusters();

}  // namespace natator::cpu
