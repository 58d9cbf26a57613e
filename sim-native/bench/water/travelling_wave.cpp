#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "water/free_motion.h"
#include "water/larva.h"
#include "water/water_tank.h"

namespace natator::bench {
namespace {

constexpr double length = 1.6 * water_length;  ///< of the body: 32 particles at resolution 20
constexpr double frequency = 0.5;              ///< 1/s
constexpr double box_length = 2.3, box_height = 0.8, box_width = 1.2;  ///< of the body's length
constexpr double nose = 1.5, step = 0.2;  ///< likewise: where the nose begins, and how far it goes until the box is moved along
constexpr double gravity = 5;             ///< length/s^2: enough for the water to follow the tail
constexpr int counted = 2;                ///< beats at the end of a leg

/// A part of the way.
struct Leg {
    double viscosity;  ///< length^2/s
    int beats;
};
constexpr Leg legs[] = {{0.003, 7}, {0.006, 4}, {0.01, 4}};
constexpr double most_drift = 0.2;  ///< to the side, of the length: nearer to a wall it swims in other water
// Every beat throws it off its course by a degree or so. It is turned back slowly, by what it does in the mean over a beat.
constexpr double course_per_drift = 0.7;   ///< radians for a length
constexpr double steering_time = 6;        ///< s

/// Steers by the last beat.
class Helm {
public:
    explicit Helm(long frames_per_beat) : size_(static_cast<std::size_t>(frames_per_beat)) {}

    /// The rate to turn by, 1/s, after a frame; `out`: from the middle, along z, of the length.
    double rate(double angle, double out) {
        seen_.emplace_back(angle, out);
        if (seen_.size() > size_) seen_.pop_front();
        if (seen_.size() < size_) return 0;
        Eigen::Vector2d mean = Eigen::Vector2d::Zero();
        for (const Eigen::Vector2d& one : seen_) mean += one / static_cast<double>(size_);
        drift_ = std::max(drift_, std::abs(mean.y()));
        return (course_per_drift * mean.y() - mean.x()) / steering_time;
    }
    double drift() const { return drift_; }  ///< the most, of the length

private:
    std::size_t size_;
    std::deque<Eigen::Vector2d> seen_;
    double drift_ = 0;
};

/// Speed and beat of the tail of what has been followed.
class Track {
public:
    void add(double time, const Eigen::Vector3d& centre, const Eigen::Vector3d& tail) {
        time_.push_back(time);
        centre_.push_back(centre);
        tail_.push_back(tail);
    }
    Eigen::Vector3d velocity() const { return (centre_.back() - centre_.front()) / (time_.back() - time_.front()); }
    double speed() const { return velocity().norm(); }
    /// From side to side of the way.
    double beat() const {
        const Eigen::Vector3d side = Eigen::Vector3d::UnitY().cross(velocity().normalized());
        double least = std::numeric_limits<double>::infinity(), greatest = -least;
        for (const Eigen::Vector3d& at : tail_) {
            const double out = side.dot(at - centre_.front());
            least = std::min(least, out);
            greatest = std::max(greatest, out);
        }
        return greatest - least;
    }

private:
    std::vector<double> time_;
    std::vector<Eigen::Vector3d> centre_, tail_;
};

/// The larva in its box of water, from start to end.
template <class Real>
class Swim {
public:
    explicit Swim(const WaterSetting& setting)
        : spacing_(spacing_of(setting)),
          larva_(length, frequency, spacing_),
          count_(even(box_length, setting), even(box_height, setting), even(box_width, setting)),
          start_(nose * length, count_.y() * spacing_ / 2, count_.z() * spacing_ / 2),
          tank_(count_, setting, [this](Model& model) { immerse(model); }),
          motion_(places_of_body()),
          frames_per_beat_(std::lround(larva_.beat() / tank_.model().time_step)),
          helm_(frames_per_beat_) {
        for (const Eigen::Vector3d& place : motion_.places()) {
            straight_.push_back(place - start_);
            if (straight_.back().x() < straight_[tail_].x()) tail_ = straight_.size() - 1;
        }
    }

    WaterRun run() {
        if (std::ranges::all_of(legs, [this](const Leg& leg) { return swim(leg); }))
            figures_.push_back({.value = helm_.drift(), .reference = 0, .greatest = most_drift});
        WaterRun run = tank_.run();
        run.figures = figures_;
        run.curve = curve_;
        return run;
    }

private:
    static int even(double size, const WaterSetting& setting) {
        return 2 * particles_along(size * length / 2, setting);
    }

    void immerse(Model& model) {
        model.parameters.gravity = {0, -gravity, 0};
        body_ = hold([this](const Eigen::Vector3d& x) { return larva_.holds(x - start_); }, model);
    }
    std::vector<Eigen::Vector3d> places_of_body() const {
        std::vector<Eigen::Vector3d> places;
        for (const int i : body_) places.push_back(tank_.state().position[i].template cast<double>());
        return places;
    }

    /// False if the water becomes unstable, or is too viscous.
    bool swim(const Leg& leg) {
        if (!tank_.set_kinematic_viscosity(leg.viscosity)) return false;
        Track track;
        for (long k = 1; k <= leg.beats * frames_per_beat_; ++k) {
            if (!advance_frame()) return false;
            const Eigen::Vector3d way(shifted_, 0, 0);
            if (k >= (leg.beats - counted) * frames_per_beat_)
                track.add(time_, motion_.centre() + way, motion_.places()[tail_] + way);
            curve_.push_back({time_, motion_.velocity().x() / length});
            move_box_along();
        }
        add_figures(track, leg.viscosity);
        return true;
    }

    /// False if the water becomes unstable.
    bool advance_frame() {
        const double frame = tank_.model().time_step, h = frame / tank_.model().parameters.substeps;
        const double before = motion_.centre().x();
        const auto arrive_with = [&](double, const std::vector<Vector3<Real>>& forces) { arrive(forces, h); };
        if (!tank_.drive([&] { set_off(h); }, arrive_with)) return false;
        time_ += frame;
        unshifted_ += motion_.centre().x() - before;
        motion_.steer(helm_.rate(motion_.angle(), (motion_.centre() - start_).z() / length));
        return true;
    }

    /// A substep of h, s, begins: the body bends on.
    void set_off(double h) {
        bending_time_ += h;
        const std::vector<Eigen::Vector3d> velocities = motion_.set_off(larva_.bent(straight_, bending_time_), h);
        for (std::size_t k = 0; k < body_.size(); ++k)
            tank_.state().velocity[body_[k]] = velocities[k].template cast<Real>();
    }

    /// It is over; `forces` are the water's, by particle.
    void arrive(const std::vector<Vector3<Real>>& forces, double h) {
        std::vector<Eigen::Vector3d> on_body;
        for (const int i : body_) on_body.push_back(forces[i].template cast<double>());
        motion_.arrive(on_body, h);
        for (std::size_t k = 0; k < body_.size(); ++k)
            tank_.state().position[body_[k]] = motion_.places()[k].template cast<Real>();
    }

    /// By whole spacings, once the body has gone far enough.
    void move_box_along() {
        const double box_step = std::round(step * length / spacing_) * spacing_;
        if (unshifted_ < box_step) return;
        tank_.shift(box_step);
        motion_.shift({-box_step, 0, 0});
        shifted_ += box_step;
        unshifted_ -= box_step;
    }

    void add_figures(const Track& track, double viscosity) {
        const double reynolds = track.speed() * length / viscosity;
        const double beating = frequency * track.beat();
        figures_.push_back(figure_within(0.25, beating / track.speed(), strouhal_of_larvae(reynolds)));
        figures_.push_back({.value = reynolds, .reference = reynolds_of_larvae(beating * length / viscosity)});
        figures_.push_back({.value = track.beat() / length, .reference = 0.5});
    }

    double spacing_;
    Larva larva_;
    Eigen::Vector3i count_;
    Eigen::Vector3d start_;  ///< of the nose
    std::vector<int> body_;  ///< its particles
    WaterTank<Real> tank_;
    FreeMotion motion_;
    std::vector<Eigen::Vector3d> straight_;  ///< places of the body's particles, as Larva has them
    std::size_t tail_ = 0;                   ///< the rearmost of them
    long frames_per_beat_;
    Helm helm_;
    double time_ = 0, bending_time_ = 0;  ///< s
    double shifted_ = 0, unshifted_ = 0;  ///< how far the box was moved along, and has still to be
    std::vector<WaterFigure> figures_;
    std::vector<WaterSample> curve_;
};

}  // namespace

/// A larva that beats its tail and swims as far as the water pushes it, ever more viscous.
WaterRun run_travelling_wave(const WaterSetting& setting) {
    return in_precision(setting.solver.precision, [&](auto real) { return Swim<decltype(real)>(setting).run(); });
}

}  // namespace natator::bench
