#include "natator/measure.h"

#include <cmath>

#include "model/check_model.h"

namespace natator {

static double forward_of(double along_x, double along_z, double yaw) {
    return along_x * std::cos(yaw / 2) + along_z * std::sin(yaw / 2);
}

template <class Real>
Course course_of(const Model& model, const Body& body, const State<Real>& end, double distance) {
    Course course;
    if (body.particles.size() < 3) return course;
    check_places(model, end);
    double rest = 0, now = 0;
    const std::vector<Eigen::Vector3d> places = body_places(body, end);
    for (std::size_t i = 0; i < places.size(); ++i) {
        rest += model.position[body.particles[i]].z();
        now += places[i].z();
    }
    const Pose pose = pose_of(model, body, places);
    course.yaw = pose.yaw;
    course.roll = pose.roll;
    course.forward = forward_of(distance, (now - rest) / static_cast<double>(places.size()), pose.yaw);
    return course;
}

template Course course_of(const Model&, const Body&, const State<float>&, double);
template Course course_of(const Model&, const Body&, const State<double>&, double);

}  // namespace natator
