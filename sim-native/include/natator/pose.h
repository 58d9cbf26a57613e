#pragma once

#include <Eigen/Core>
#include <vector>

#include "natator/model.h"
#include "natator/state.h"

namespace natator {

/// Where a body is and how it lies, against the model at rest. Its rotation is that of all its particles that fits best
/// (Umeyama 1991), so that bends to both sides do not count.
struct Pose {
    Eigen::Vector3d centre{0, 0, 0};   ///< mean of its particles, length
    Eigen::Vector3d heading{1, 0, 0};  ///< where its head points; length 1
    double yaw = 0;                    ///< angle of the heading in the horizontal plane, from +x towards +z, rad
    double pitch = 0;                  ///< angle of the heading above the horizontal plane, rad
    double roll = 0;                   ///< angle of its back about its heading, from vertical to its right, rad
};

/// Mean of some places; 0 of none.
Eigen::Vector3d mean_place(const std::vector<Eigen::Vector3d>& places);

/// Mean of the body's particles in the model at rest, length.
Eigen::Vector3d rest_centre(const Model& model);

/// The rotation of a body from its rest shape that fits best: its columns are where its forward, up and right point.
/// `places` as in pose_of, and refused as there; the identity for fewer than three.
Eigen::Matrix3d body_rotation(const Model& model, const Body& body, const std::vector<Eigen::Vector3d>& places);

/// `places`: of a body's particles, in the order of Body::particles; of more or fewer InputError is thrown. A body of fewer than three
/// has no rotation.
Pose pose_of(const Model& model, const Body& body, const std::vector<Eigen::Vector3d>& places);

/// Places of the body's particles in the coordinates of its tank, in the order of Body::particles.
template <class Real>
std::vector<Eigen::Vector3d> body_places_in_tank(const Body& body, const State<Real>& state);

/// Places over ground of the body's particles, in the order of Body::particles.
template <class Real>
std::vector<Eigen::Vector3d> body_places(const Body& body, const State<Real>& state);

}  // namespace natator
