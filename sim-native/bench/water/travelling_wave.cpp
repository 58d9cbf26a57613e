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

template <class Real>
WaterRun run_as(const WaterSetting& setting) {
    const double spacing = spacing_of(setting);
    const Larva larva(length, frequency, spacing);
    const auto even = [&](double size) { return 2 * particles_along(size * length / 2, setting); };
    const Eigen::Vector3i count(even(box_length), even(box_height), even(box_width));
    const Eigen::Vector3d start(nose * length, count.y() * spacing / 2, count.z() * spacing / 2);
    std::vector<int> body;
    WaterTank<Real> tank(count, setting, [&](Model& model) {
        model.parameters.gravity = {0, -gravity, 0};
        body = hold([&](const Eigen::Vector3d& x) { return larva.holds(x - start); }, model);
    });
    State<Real>& state = tank.state();
    std::vector<Eigen::Vector3d> places, straight;
    std::size_t tail = 0;
    for (const int i : body) {
        places.push_back(state.position[i].template cast<double>());
        straight.push_back(places.back() - start);
        if (straight.back().x() < straight[tail].x()) tail = straight.size() - 1;
    }
    FreeMotion motion(places);
    const double frame = tank.model().time_step, h = frame / tank.model().parameters.substeps;
    const double box_step = std::round(step * length / spacing) * spacing;
    double time = 0, bending_time = 0, unshifted = 0, shifted = 0;
    const auto set_off = [&] {
        bending_time += h;
        const std::vector<Eigen::Vector3d> velocities = motion.set_off(larva.bent(straight, bending_time), h);
        for (std::size_t k = 0; k < body.size(); ++k) state.velocity[body[k]] = velocities[k].template cast<Real>();
    };
    const auto arrive = [&](double, const std::vector<Vector3<Real>>& forces) {
        std::vector<Eigen::Vector3d> on_body;
        for (const int i : body) on_body.push_back(forces[i].template cast<double>());
        motion.arrive(on_body, h);
        for (std::size_t k = 0; k < body.size(); ++k) state.position[body[k]] = motion.places()[k].template cast<Real>();
    };

    std::vector<WaterFigure> figures;
    std::vector<WaterSample> curve;
    const long frames_per_beat = std::lround(larva.beat() / frame);
    Helm helm(frames_per_beat);
    for (const auto& [viscosity, beats] : legs) {
        tank.set_kinematic_viscosity(viscosity);
        Track track;
        for (long k = 1; k <= beats * frames_per_beat; ++k) {
            const double before = motion.centre().x();
            if (!tank.drive(set_off, arrive)) return tank.run();
            time += frame;
            unshifted += motion.centre().x() - before;
            motion.steer(helm.rate(motion.angle(), (motion.centre() - start).z() / length));
            const Eigen::Vector3d way(shifted, 0, 0);
            if (k >= (beats - counted) * frames_per_beat)
                track.add(time, motion.centre() + way, motion.places()[tail] + way);
            curve.push_back({time, motion.velocity().x() / length});
            if (unshifted < box_step) continue;
            tank.shift(box_step);
            motion.shift({-box_step, 0, 0});
            shifted += box_step;
            unshifted -= box_step;
        }
        const double reynolds = track.speed() * length / viscosity;
        const double beating = frequency * track.beat();
        figures.push_back(figure_within(0.25, beating / track.speed(), strouhal_of_larvae(reynolds)));
        figures.push_back({.value = reynolds, .reference = reynolds_of_larvae(beating * length / viscosity)});
        figures.push_back({.value = track.beat() / length, .reference = 0.5});
    }
    figures.push_back({.value = helm.drift(), .reference = 0, .greatest = most_drift});
    WaterRun run = tank.run();
    run.figures = figures;
    run.curve = curve;
    return run;
}

}  // namespace

/// A larva that beats its tail and swims as far as the water pushes it, ever more viscous.
WaterRun run_travelling_wave(const WaterSetting& setting) {
    return in_precision(setting.solver.precision, [&](auto real) { return run_as<decltype(real)>(setting); });
}

}  // namespace natator::bench
