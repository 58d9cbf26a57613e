#include "water/swim.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace natator::bench {
namespace {

/// Of the body's length: where the nose begins, in the usual box, and how far it goes until the box is moved along.
constexpr double nose_at = 1.5, step = 0.2;
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

SwimBody::SwimBody(const Swimmer& swimmer, const SwimScene& scene, const Eigen::Vector3d& nose,
                   std::vector<Eigen::Vector3d> places, double frame, double kept)
    : swimmer_(swimmer),
      scene_(scene),
      start_(nose),
      frame_(frame),
      frames_per_beat_(std::lround(scene.beat / frame)),
      motion_(std::move(places), kept, !swimmer.endless),
      helm_(frames_per_beat_) {
    for (const Eigen::Vector3d& place : motion_.places()) {
        straight_.push_back(place - start_);
        if (straight_.back().x() < straight_[tail_].x()) tail_ = straight_.size() - 1;
    }
}

void SwimBody::begin_frame() {
    before_ = motion_.centre().x();
    force_ = power_ = 0;
}

const std::vector<Eigen::Vector3d>& SwimBody::set_off(double h) {
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
    return velocities_;
}

void SwimBody::arrive(const std::vector<Eigen::Vector3d>& forces, double h) {
    const double part = h / frame_;
    for (std::size_t k = 0; k < forces.size(); ++k) {
        force_ += part * forces[k].x();
        power_ -= part * forces[k].dot(velocities_[k]);
    }
    motion_.arrive(forces, h);
}

double SwimBody::end_frame(double spacing, double far) {
    time_ += frame_;
    unshifted_ += motion_.centre().x() - before_;
    motion_.steer(helm_.rate(motion_.angle(), (motion_.centre() - start_).z() / scene_.length));
    const double box_step =
        std::copysign(std::max(1.0, std::round(far * scene_.length / spacing)) * spacing, unshifted_);
    if (std::abs(unshifted_) < std::abs(box_step)) return 0;
    motion_.shift({-box_step, 0, 0});
    shifted_ += box_step;
    unshifted_ -= box_step;
    return box_step;
}

template <class Real>
Swim<Real>::Swim(const Swimmer& swimmer, const SwimScene& scene, const WaterSetting& setting)
    : spacing_(spacing_of(setting)),
      count_((scene.length / 2 * scene.box / spacing_).array().round().matrix().template cast<int>() * 2),
      start_(scene.box.x() / 2.3 * nose_at * scene.length, count_.y() * spacing_ / 2, count_.z() * spacing_ / 2),
      tank_(count_, setting, [&](Model& model) {
          model.parameters.gravity = {0, -scene.gravity, 0};
          held_ =
              hold([&](const Eigen::Vector3d& x) { return swimmer.holds(x - start_, scene.length, spacing_); }, model);
      }) {
    std::vector<Eigen::Vector3d> places;
    for (const int i : held_) places.push_back(tank_.state().position[i].template cast<double>());
    body_.emplace(swimmer, scene, start_, std::move(places), tank_.model().time_step, kept_among_particles);
}

template <class Real>
bool Swim<Real>::frame() {
    const double h = tank_.model().time_step / tank_.model().parameters.substeps;
    body_->begin_frame();
    const auto set_off = [&] {
        const std::vector<Eigen::Vector3d>& velocities = body_->set_off(h);
        for (std::size_t k = 0; k < held_.size(); ++k)
            tank_.state().velocity[held_[k]] = velocities[k].template cast<Real>();
    };
    const auto arrive = [&](double, const std::vector<Vector3<Real>>& forces) {
        std::vector<Eigen::Vector3d> on_body;
        for (const int i : held_) on_body.push_back(forces[i].template cast<double>());
        body_->arrive(on_body, h);
        for (std::size_t k = 0; k < held_.size(); ++k)
            tank_.state().position[held_[k]] = body_->places()[k].template cast<Real>();
    };
    if (!tank_.drive(set_off, arrive)) return false;
    if (const double by = body_->end_frame(spacing_, step); by != 0) tank_.shift(by);
    return true;
}

template class Swim<float>;
template class Swim<double>;

}  // namespace natator::bench
