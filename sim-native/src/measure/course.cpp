#include "natator/course.h"

#include <Eigen/Geometry>
#include <cmath>

namespace natator {

template <class Real>
Course course_of(const Model& model, const State<Real>& end, double distance) {
    const auto count = static_cast<Eigen::Index>(model.body.particles.size());
    Course course;
    if (count < 3) return course;
    Eigen::Matrix3Xd rest(3, count), now(3, count);
    for (Eigen::Index i = 0; i < count; ++i) {
        rest.col(i) = model.position[model.body.particles[i]];
        now.col(i) = end.position[model.body.particles[i]].template cast<double>();
    }
    const Eigen::Matrix3d rotation = Eigen::umeyama(rest, now, false).template topLeftCorner<3, 3>();
    const Eigen::Vector3d heading = rotation.col(0), back = rotation.col(1);
    course.yaw = std::atan2(heading.z(), heading.x());
    const Eigen::Vector3d right = heading.cross(Eigen::Vector3d::UnitY());  // +z of a body that heads along +x
    if (right.norm() > 0) course.roll = std::atan2(back.dot(right.normalized()), back.dot(right.cross(heading).normalized()));
    const double aside = now.row(2).mean() - rest.row(2).mean(), half = course.yaw / 2;
    course.forward = distance * std::cos(half) + aside * std::sin(half);
    return course;
}

template Course course_of(const Model&, const State<float>&, double);
template Course course_of(const Model&, const State<double>&, double);

}  // namespace natator
