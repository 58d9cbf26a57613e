#include "boundaries.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "water_volumes.h"

namespace natator {

/// The grain is what Real has left behind the point for all places in the tank and their ghosts.
template <class Real>
std::vector<physics::PeriodicAxis<Real>> periodic_axes_of(const Model& model) {
    std::vector<physics::PeriodicAxis<Real>> axes;
    for (const PeriodicAxis& periodic : model.periodic) {
        const double reach = support(model);
        int exponent = 0;
        std::frexp(std::max(std::abs(periodic.low - reach), std::abs(periodic.high + reach)), &exponent);
        const double grain = std::ldexp(1.0, exponent - std::numeric_limits<Real>::digits);
        const auto on_grain = [grain](double x) { return static_cast<Real>(grain * std::rint(x / grain)); };
        axes.push_back({periodic.axis, on_grain(periodic.low), on_grain(periodic.length()), static_cast<Real>(grain)});
    }
    return axes;
}

template <class Real>
std::vector<physics::Boundary<Real>> boundaries_of(const Model& model) {
    std::vector<physics::Boundary<Real>> boundaries;
    for (const physics::PeriodicAxis<Real>& periodic : periodic_axes_of<Real>(model)) {
        const auto towards = [&](Real direction) { return with(physics::Vec3<Real>{}, periodic.axis, direction); };
        boundaries.push_back({{towards(1), -periodic.low}, periodic.length});
        // What is at the very end is the ghost of what is at the other, and has none itself.
        boundaries.push_back({{towards(-1), periodic.low + periodic.length - periodic.grain}, periodic.length});
    }
    for (const Plane& plane : model.planes) {
        const auto& n = plane.normal;
        boundaries.push_back({{{static_cast<Real>(n.x()), static_cast<Real>(n.y()), static_cast<Real>(n.z())},
                               static_cast<Real>(plane.offset)},
                              Real(0)});
    }
    return boundaries;
}

Eigen::Vector3d gravity_on_walls(const Model& model) {
    return gravity_on_walls(model.parameters, model.periodic);
}

Eigen::Vector3d gravity_on_walls(const SolverParameters& parameters, const std::vector<PeriodicAxis>& periodic) {
    Eigen::Vector3d gravity = parameters.gravity;
    for (const PeriodicAxis& one : periodic) gravity[one.axis] = 0;
    return gravity;
}

Eigen::Vector3d minimum_image(const Model& model, Eigen::Vector3d difference) {
    for (const PeriodicAxis& periodic : model.periodic) {
        double& along = difference[periodic.axis];
        along -= periodic.length() * std::round(along / periodic.length());
    }
    return difference;
}

template std::vector<physics::PeriodicAxis<float>> periodic_axes_of(const Model&);
template std::vector<physics::PeriodicAxis<double>> periodic_axes_of(const Model&);
template std::vector<physics::Boundary<float>> boundaries_of(const Model&);
template std::vector<physics::Boundary<double>> boundaries_of(const Model&);

}  // namespace natator
