#include <cmath>

#include "../rotation_fit.h"
#include "conserving_stages.h"

namespace natator::cpu {
namespace {

constexpr int most_rotation_fit_steps = 20;  ///< the fit ends by itself once it has converged

}  // namespace

/// Shape matching (Müller, Heidelberger, Teschner, Gross: Meshless Deformations Based on Shape Matching, 2005) with the
/// masses m_j / n_j, n_j = clusters of particle j, so that each cluster alone keeps its momentum; a particle goes to
/// the average of its clusters' goals g. Compliance relative to the mass, by XPBD with the displacement d_j so far:
///   Dx_j = 1/n_j sum over clusters of ((g_j - x_j) - alpha d_j) / (1 + alpha).
template <class Real>
void ConservingStages<Real>::solve_clusters() {
    for (std::size_t k = 0; k < model_.clusters.size(); ++k) {
        const double compliance = relative_compliance(model_.clusters[k].stiffness, h_);
        if (!std::isfinite(compliance)) continue;
        const Real alpha = static_cast<Real>(compliance);
        const std::vector<int>& members = model_.clusters[k].particles;
        const std::vector<Vector3<Real>>& offsets = cluster_offset_[k];

        Vector3<double> sum = Vector3<double>::Zero();
        double total = 0;
        for (std::size_t m = 0; m < members.size(); ++m) {
            const double mass = static_cast<double>(cluster_mass_[k][m]);
            sum += mass * position_of_slot(ws_.slot_of[members[m]]).template cast<double>();
            total += mass;
        }
        const Vector3<double> centre = sum / total;

        Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
        for (std::size_t m = 0; m < members.size(); ++m) {
            const Vector3<double> arm = position_of_slot(ws_.slot_of[members[m]]).template cast<double>() - centre;
            covariance +=
                static_cast<double>(cluster_mass_[k][m]) * arm * offsets[m].template cast<double>().transpose();
        }
        Eigen::Quaterniond rotation = cluster_rotation_[k].template cast<double>();
        fit_rotation(covariance, rotation, most_rotation_fit_steps);
        cluster_rotation_[k] = rotation.template cast<Real>();
        cluster_centre_[k] = centre.template cast<Real>();

        const Eigen::Matrix3d matrix = rotation.toRotationMatrix();
        for (std::size_t m = 0; m < members.size(); ++m) {
            const int slot = ws_.slot_of[members[m]];
            const Vector3<double> goal = centre + matrix * offsets[m].template cast<double>();
            const Vector3<Real> away = (goal - position_of_slot(slot).template cast<double>()).template cast<Real>();
            Vector3<Real>& displacement = cluster_displacement_[k][m];
            const Vector3<Real> change = (away - alpha * displacement) / (1 + alpha);
            displacement += change;
            ws_.correction.add(slot, change * (cluster_mass_[k][m] * ws_.inverse_mass[slot]));
        }
    }
    apply_internal_corrections();
}

template void ConservingStages<float>::solve_clusters();
template void ConservingStages<double>::solve_clusters();

}  // namespace natator::cpu
