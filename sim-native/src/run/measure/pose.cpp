#include "natator/measure.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "natator/error.h"

namespace natator {

Eigen::Vector3d mean_place(const std::vector<Eigen::Vector3d>& places) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& place : places) sum += place;
    return places.empty() ? sum : Eigen::Vector3d(sum / static_cast<double>(places.size()));
}

Eigen::Vector3d rest_centre(const Model& model) {
    std::vector<Eigen::Vector3d> places;
    for (const int particle : model.body.particles) places.push_back(model.position[particle]);
    return mean_place(places);
}

Eigen::Matrix3d body_rotation(const Model& model, const Body& body, const std::vector<Eigen::Vector3d>& places) {
    if (places.size() != body.particles.size())
        throw InputError("pose of " + std::to_string(places.size()) + " places: must have " +
                         std::to_string(body.particles.size()) + " as the body has particles");
    if (places.size() < 3) return Eigen::Matrix3d::Identity();
    const auto count = static_cast<Eigen::Index>(places.size());
    Eigen::Matrix3Xd rest(3, count), now(3, count);
    for (Eigen::Index i = 0; i < count; ++i) {
        rest.col(i) = model.position[body.particles[i]];
        now.col(i) = places[i];
    }
    return Eigen::umeyama(rest, now, false).template topLeftCorner<3, 3>();
}

Pose pose_of(const Model& model, const Body& body, const std::vector<Eigen::Vector3d>& places) {
    Pose pose;
    pose.centre = mean_place(places);
    const Eigen::Matrix3d rotation = body_rotation(model, body, places);
    if (places.size() < 3) return pose;
    const Eigen::Vector3d back = rotation.col(1);
    pose.heading = rotation.col(0);
    pose.yaw = std::atan2(pose.heading.z(), pose.heading.x());
    pose.pitch = std::asin(std::clamp(pose.heading.y(), -1.0, 1.0));
    const Eigen::Vector3d right = pose.heading.cross(Eigen::Vector3d::UnitY());  // +z of a body that heads along +x
    if (right.norm() > 0)
        pose.roll = std::atan2(back.dot(right.normalized()), back.dot(right.cross(pose.heading).normalized()));
    return pose;
}

template <class Real>
std::vector<Eigen::Vector3d> body_places_in_tank(const Body& body, const State<Real>& state) {
    std::vector<Eigen::Vector3d> places;
    places.reserve(body.particles.size());
    for (const int particle : body.particles) places.push_back(state.position[particle].template cast<double>());
    return places;
}

template <class Real>
std::vector<Eigen::Vector3d> body_places(const Body& body, const State<Real>& state) {
    std::vector<Eigen::Vector3d> places = body_places_in_tank(body, state);
    for (Eigen::Vector3d& place : places) place += state.origin;
    return places;
}

template std::vector<Eigen::Vector3d> body_places_in_tank(const Body&, const State<float>&);
template std::vector<Eigen::Vector3d> body_places_in_tank(const Body&, const State<double>&);
template std::vector<Eigen::Vector3d> body_places(const Body&, const State<float>&);
template std::vector<Eigen::Vector3d> body_places(const Body&, const State<double>&);

}  // namespace natator
