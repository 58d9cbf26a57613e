#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "natator/model.h"
#include "natator/solver.h"
#include "water/water_case.h"

namespace natator::bench {

/// Length of the cases along x, in units of the scene. With 20 particles along it their spacing is that of the thesis.
inline constexpr double water_length = 2;

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
    /// Of the water as it is, taken as of even density: twice its mean height, length.
    double depth() const;

    /// Advances by one frame. False if the water is unstable; then there are no more frames.
    bool frame();
    /// Of the model, from now on.
    void change(const Change& how);
    void set_gravity(const Eigen::Vector3d& gravity);
    /// length^2/s; means nothing to the schemes that take none.
    void set_kinematic_viscosity(double viscosity);

    /// A run with what is known of the tank so far: particles, wall time of the frames, instability.
    WaterRun run() const;

private:
    using Step = std::function<std::optional<Instability>(State<Real>&)>;

    Step step_of(const Model& model) const;
    void settle();

    WaterSetting setting_;
    std::shared_ptr<Model> model_;
    State<Real> state_;
    Step step_;
    double seconds_ = 0;
    std::optional<Instability> instability_;
};

extern template class WaterTank<float>;
extern template class WaterTank<double>;

/// Calls a case's template with the precision that the setting asks for.
template <class Float, class Double>
WaterRun in_precision(const WaterSetting& setting, Float&& in_float, Double&& in_double) {
    return setting.solver.precision == Precision::double_precision ? in_double(setting) : in_float(setting);
}

}  // namespace natator::bench
