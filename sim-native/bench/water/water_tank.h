#pragma once

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>

#include "in_precision.h"
#include "natator/model.h"
#include "water/water_case.h"

namespace natator::bench {

/// Length of the cases along x, in units of the scene. With 20 particles along it their spacing is that of the thesis.
inline constexpr double water_length = 2;

inline double spacing_of(const WaterSetting& setting) {
    return water_length / setting.resolution;
}
/// How many particles fit along a length.
inline int particles_along(double length, const WaterSetting& setting) {
    return static_cast<int>(std::lround(length / spacing_of(setting)));
}
inline double diameter_of_sphere(double volume) {
    return std::cbrt(6 * volume / std::numbers::pi);
}

/// How a body is moved.
struct Motion {
    Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< length/s
    Eigen::Vector3d spin = Eigen::Vector3d::Zero();      ///< about its middle, 1/s
};

/// What the water does to it in a frame, in the mean.
struct Load {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< mass length/s^2
    Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< about its middle, mass length^2/s^2
};

/// A box of water without friction, drag or viscosity that has come to rest under gravity (10 length/s^2, downwards).
/// Walls stand at x = 0, z = 0 and behind the last particles; the surface is free.
template <class Real>
class WaterTank {
public:
    using Change = std::function<void(Model&)>;

    /// `count` particles along x, y and z, at the spacing water_length / resolution; `immerse` puts bodies in their
    /// lattice.
    WaterTank(const Eigen::Vector3i& count, const WaterSetting& setting, const Change& immerse = {});

    const Model& model() const { return *model_; }
    State<Real>& state() { return state_; }
    const State<Real>& state() const { return state_; }
    /// Of each particle in the last substep, mass/(length s^2).
    std::vector<Real> pressures() const { return pressures_(); }
    /// Mean over all particles of what they have at their places and with their velocities.
    double mean(const std::function<double(const Eigen::Vector3d&, const Eigen::Vector3d&)>& value) const;
    /// Of the water as it is, taken as of even density: twice its mean height, length.
    double depth() const;
    /// Of the slowest mode of water that deep, half a wave along water_length, by linear theory: 2 pi over the root of
    /// g k tanh kh, s.
    double sloshing_period() const;

    /// Advances by one frame. False if the water is unstable; then there are no more frames.
    bool frame();
    /// Frames for as long as that, s, as far as the water stays stable. The curve is value() before the first and after
    /// every one.
    WaterRun follow(double duration, const std::function<double()>& value);
    /// A frame while the particles of infinite mass move as one rigid body.
    bool drive(const Motion& motion, Load& load);
    /// A frame while each particle of infinite mass moves at the velocity that `velocity` gives it; `force` becomes the
    /// mean force of the water on each particle.
    bool drive(const std::function<Eigen::Vector3d(int)>& velocity, std::vector<Eigen::Vector3d>& force);
    /// A frame: before each substep `set_off` gives the particles of infinite mass their velocities, after it `arrive`
    /// gets the substep, s, and the forces of the water on each particle, and moves them on.
    bool drive(const std::function<void()>& set_off,
               const std::function<void(double, const std::vector<Vector3<Real>>&)>& arrive);
    /// Moves the walls along x by so much, or back: the water that is left behind the rear one is put before the front,
    /// at rest. All coordinates are less by `distance` afterwards, so that the walls keep theirs.
    void shift(double distance);
    /// Of the model, from now on.
    void change(const Change& how);
    void set_gravity(const Eigen::Vector3d& gravity);
    /// length^2/s; means nothing to the schemes that take none. False where it is more than a substep bears; then it
    /// stays as it was.
    [[nodiscard]] bool set_kinematic_viscosity(double viscosity);

    /// A run with what is known of the tank so far: particles, wall time of the frames, instability.
    WaterRun run() const;

private:
    /// Advances by a time (s) in so many substeps.
    using Step = std::function<std::optional<Instability>(State<Real>&, double, int)>;

    Step step_of(const Model& model);
    void settle();
    bool advance(double time, int substeps);
    std::vector<int> held() const;
    WaterSetting setting_;
    std::shared_ptr<Model> model_;
    double length_;  ///< along x
    State<Real> state_;
    Step step_;
    std::function<std::vector<Real>()> pressures_;        ///< of step_
    std::function<std::vector<Vector3<Real>>()> forces_;  ///< likewise
    double seconds_ = 0;
    std::optional<Instability> instability_;
};

extern template class WaterTank<float>;
extern template class WaterTank<double>;

/// Particles whose places `inside` takes become a body that is held. Returns them.
std::vector<int> hold(const std::function<bool(const Eigen::Vector3d&)>& inside, Model& model);

}  // namespace natator::bench
