#include "water/swim.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace natator::bench {
namespace {

/// Of the body's length: where the nose begins, in the usual box, and how far it goes until the box is moved along.
constexpr double nose = 1.5, step = 0.2;
constexpr double course_per_drift = 0.7;  ///< radians for a length
constexpr double steering_time = 6;       ///< s

}  // namespace

double Track::beat(const Eigen::Vector3d& side) const {
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
    for (const Eigen::Vector3d& at : tail) {
        const double out = side.dot(at - centre.front());
        least = std::min(least, out);
        greatest = std::max(greatest, out);
    }
    return greatest - least;
}

double Helm::rate(double angle, double out) {
    seen_.emplace_back(angle, out);
    if (seen_.size() > size_) seen_.pop_front();
    if (seen_.size() < size_) return 0;
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const Eigen::Vector2d& one : seen_) mean += one / static_cast<double>(size_);
    drift_ = std::max(drift_, std::abs(mean.y()));
    return (course_per_drift * mean.y() - mean.x()) / steering_time;
}

template <class Real>
Swim<Real>::Swim(const Swimmer& swimmer, const SwimScene& scene, const WaterSetting& setting)
    : spacing_(spacing_of(setting)),
      swimmer_(swimmer),
      scene_(scene),
      count_((scene.length / 2 * scene.box / spacing_).array().round().matrix().cast<int>() * 2),
      start_(scene.box.x() / 2.3 * nose * scene.length, count_.y() * spacing_ / 2, count_.z() * spacing_ / 2),
      tank_(count_, setting, [this](Model& model) { immerse(model); }),
      motion_(places_of_body()),
      frames_per_beat_(std::lround(scene.beat / tank_.model().time_step)),
      helm_(frames_per_beat_) {
    for (const Eigen::Vector3d& place : motion_.places()) {
        straight_.push_back(place - start_);
        if (straight_.back().x() < straight_[tail_].x()) tail_ = straight_.size() - 1;
    }
}

template <class Real>
void Swim<Real>::immerse(Model& model) {
    model.parameters.gravity = {0, -scene_.gravity, 0};
    body_ = hold([this](const Eigen::Vector3d& x) { return swimmer_.holds(x - start_, scene_.length, spacing_); }, model);
}

template <class Real>
std::vector<Eigen::Vector3d> Swim<Real>::places_of_body() const {
    std::vector<Eigen::Vector3d> places;
    for (const int i : body_) places.push_back(tank_.state().position[i].template cast<double>());
    return places;
}

template <class Real>
bool Swim<Real>::frame() {
    const double frame = tank_.model().time_step, h = frame / tank_.model().parameters.substeps;
    const double before = motion_.centre().x();
    force_ = power_ = 0;
    const auto arrive_with = [&](double, const std::vector<Vector3<Real>>& forces) { arrive(forces, h); };
    if (!tank_.drive([&] { set_off(h); }, arrive_with)) return false;
    time_ += frame;
    unshifted_ += motion_.centre().x() - before;
    motion_.steer(helm_.rate(motion_.angle(), (motion_.centre() - start_).z() / scene_.length));
    move_box_along();
    return true;
}

/// A substep of h, s, begins: the body bends on.
template <class Real>
void Swim<Real>::set_off(double h) {
    bending_time_ += h;
    const double beats = bending_time_ / scene_.beat;
    std::vector<Eigen::Vector3d> shape = swimmer_.bent(straight_, scene_.length, beats);
    if (swimmer_.towed) {
        towed_ += h * *swimmer_.towed * scene_.length / scene_.beat * std::min(1.0, beats);
        for (Eigen::Vector3d& x : shape) x += start_ + Eigen::Vector3d(towed_ - shifted_, 0, 0);
        velocities_ = motion_.lead(shape, h);
    } else {
        velocities_ = motion_.set_off(shape, h);
    }
    for (std::size_t k = 0; k < body_.size(); ++k)
        tank_.state().velocity[body_[k]] = velocities_[k].template cast<Real>();
}

/// It is over; `forces` are the water's, by particle.
template <class Real>
void Swim<Real>::arrive(const std::vector<Vector3<Real>>& forces, double h) {
    std::vector<Eigen::Vector3d> on_body;
    for (const int i : body_) on_body.push_back(forces[i].template cast<double>());
    const double part = h / tank_.model().time_step;
    for (std::size_t k = 0; k < body_.size(); ++k) {
        force_ += part * on_body[k].x();
        power_ -= part * on_body[k].dot(velocities_[k]);
    }
    motion_.arrive(on_body, h);
    for (std::size_t k = 0; k < body_.size(); ++k)
        tank_.state().position[body_[k]] = motion_.places()[k].template cast<Real>();
}

/// By whole spacings, once the body has gone far enough.
template <class Real>
void Swim<Real>::move_box_along() {
    const double box_step = std::copysign(std::round(step * scene_.length / spacing_) * spacing_, unshifted_);
    if (std::abs(unshifted_) < std::abs(box_step)) return;
    tank_.shift(box_step);
    motion_.shift({-box_step, 0, 0});
    shifted_ += box_step;
    unshifted_ -= box_step;
}

template class Swim<float>;
template class Swim<double>;

}  // namespace natator::bench
