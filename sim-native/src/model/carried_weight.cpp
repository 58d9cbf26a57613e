#include "carried_weight.h"

#include <algorithm>

#include "borders.h"
#include "natator/error.h"
#include "scene/tank_ends.h"
#include "water_volumes.h"

namespace natator {
namespace {

/// Along which gravity is largest: the floor is across it.
int upright_axis(const Eigen::Vector3d& gravity) {
    int axis = 0;
    gravity.cwiseAbs().maxCoeff(&axis);
    return axis;
}

const PeriodicAxis* periodic_along(int axis, const std::vector<PeriodicAxis>& periodic) {
    const auto found = std::ranges::find(periodic, axis, &PeriodicAxis::axis);
    return found == periodic.end() ? nullptr : &*found;
}

/// Gravity of the fluid along the axes that have ends, length/s^2.
Eigen::Vector3d weight_of(const Model& model) { return model.parameters.buoyancy * gravity_on_walls(model); }

bool carries(const Model& model) {
    return model.scheme == Scheme::conserving && model.parameters.modifiedPressure && !weight_of(model).isZero(0) && depth(model) > 0;
}

/// Of the tank, along an axis.
double extent(const Model& model, int axis) {
    if (const PeriodicAxis* const periodic = periodic_along(axis, model.periodic)) return periodic->length();
    const TankEnds ends = tank_ends(model.planes, axis);
    return ends.high.front() - ends.low.front();
}

}  // namespace

std::optional<std::string> no_tank(const Eigen::Vector3d& gravity, const std::vector<Plane>& planes,
                                   const std::vector<PeriodicAxis>& periodic) {
    const int up = upright_axis(gravity);
    const TankEnds upright = tank_ends(planes, up);
    const std::string needs = "needs a tank with one floor and one wall at each end, or periodic axes";
    if ((gravity[up] < 0 ? upright.low : upright.high).size() != 1) return needs;
    for (int axis = 0; axis < 3; ++axis)
        if (axis != up && !periodic_along(axis, periodic) && !tank_ends(planes, axis).one_each()) return needs;
    return std::nullopt;
}

template <class Real>
physics::CarriedWeight<Real> carried_weight(const Model& model) {
    if (!carries(model)) return {};
    const Eigen::Vector3d gravity = weight_of(model);
    if (const auto reason = no_tank(gravity, model.planes, model.periodic))
        throw InputError("model: parameters.modifiedPressure = true: " + *reason);
    const int up = upright_axis(gravity);
    const double towards = gravity[up] < 0 ? -1 : 1;  // the floor
    const TankEnds upright = tank_ends(model.planes, up);
    const double floor = towards < 0 ? -upright.low.front() : upright.high.front();
    const std::vector<double> volumes = particle_volumes(model);
    double volume = 0, area = 1;
    for (int i = 0; i < model.particles(); ++i)
        if (model.is_fluid(i)) volume += volumes[i];
    for (int axis = 0; axis < 3; ++axis)
        if (axis != up) area *= extent(model, axis);
    const double reach = support(model);
    const auto along = [&](double length) {
        physics::Vec3<Real> v{};
        (up == 0 ? v.x : up == 1 ? v.y : v.z) = static_cast<Real>(length);
        return v;
    };
    return {.gravity = along(gravity[up]),
            .down = along(towards),
            .begin = static_cast<Real>(floor - volume / area + reach),
            .width = static_cast<Real>(reach)};
}

double solved_depth(const Model& model) {
    const double all = depth(model);
    return carries(model) ? std::min(all, 1.5 * support(model)) : all;
}

template physics::CarriedWeight<float> carried_weight(const Model&);
template physics::CarriedWeight<double> carried_weight(const Model&);

}  // namespace natator
