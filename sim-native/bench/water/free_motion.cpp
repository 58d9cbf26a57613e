#include "water/free_motion.h"

namespace natator::bench {
namespace {

Eigen::Vector3d mean(const std::vector<Eigen::Vector3d>& of) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& x : of) sum += x;
    return sum / static_cast<double>(of.size());
}

}  // namespace

FreeMotion::FreeMotion(std::vector<Eigen::Vector3d> places, double kept, bool turns)
    : places_(std::move(places)), kept_(kept), turns_(turns) {}

Eigen::Vector3d FreeMotion::centre() const {
    return mean(places_);
}

std::vector<Eigen::Vector3d> FreeMotion::set_off(const std::vector<Eigen::Vector3d>& shape, double time) {
    const auto turned = [](double angle) {
        return Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
    };
    const Eigen::Vector3d here = centre(), middle = mean(shape);
    const Eigen::Matrix3d now = turned(angle_);
    double of_bending = 0, inertia = 0;
    for (std::size_t k = 0; k < places_.size(); ++k) {
        const Eigen::Vector3d arm = places_[k] - here, then = now * (shape[k] - middle);
        of_bending += arm.cross(then - arm).y() / time;
        inertia += arm.x() * arm.x() + arm.z() * arm.z();
    }
    if (turns_) angle_ += time * (steering_ + (angular_momentum_ - of_bending) / inertia);
    const Eigen::Matrix3d next = turned(angle_);
    std::vector<Eigen::Vector3d> to;
    for (const Eigen::Vector3d& x : shape) to.push_back(here + time * velocity_ + next * (x - middle));
    return lead(to, time);
}

std::vector<Eigen::Vector3d> FreeMotion::lead(const std::vector<Eigen::Vector3d>& to, double time) {
    next_ = to;
    std::vector<Eigen::Vector3d> velocities;
    for (std::size_t k = 0; k < places_.size(); ++k) velocities.push_back((next_[k] - places_[k]) / time);
    return velocities;
}

void FreeMotion::arrive(const std::vector<Eigen::Vector3d>& forces, double time) {
    const Eigen::Vector3d here = centre();
    Eigen::Vector3d force = mean(forces);  // per mass
    force.y() = 0;
    double moment = 0;
    for (std::size_t k = 0; k < places_.size(); ++k) moment += (places_[k] - here).cross(forces[k]).y();
    acceleration_ = (force + kept_ * acceleration_) / (1 + kept_);
    moment_ = (moment + kept_ * moment_) / (1 + kept_);
    velocity_ += time * acceleration_;
    angular_momentum_ += time * moment_;
    places_ = next_;
}

void FreeMotion::shift(const Eigen::Vector3d& by) {
    for (Eigen::Vector3d& x : places_) x += by;
}

}  // namespace natator::bench
