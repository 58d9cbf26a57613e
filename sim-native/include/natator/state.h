#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

namespace natator {

struct Model;

template <class Real>
using Vector3 = Eigen::Matrix<Real, 3, 1>;

/// All that changes while a scene runs, in the order of the Model's particles.
/// Real is float (default) or double (reference runs).
template <class Real>
struct State {
    std::vector<Vector3<Real>> position;
    std::vector<Vector3<Real>> velocity;
    std::vector<Eigen::Quaternion<Real>> cluster_rotation;  ///< kept between iterations, substeps and frames
    std::vector<Vector3<Real>> cluster_centre;              ///< stored centre with its dead band
    std::vector<Real> spring_rest_length;                   ///< length, as the muscles are driven
    /// Where the coordinates of a moving tank begin over ground, length: what is at x is at x + origin there.
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();
    double time = 0;                                        ///< s since the end of settling
};

/// The State that a Model starts from. Throws InputError as a Solver of the Model does.
template <class Real>
State<Real> initial_state(const Model& model);

}  // namespace natator
