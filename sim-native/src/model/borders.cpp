#include "borders.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "water_volumes.h"

namespace natator {

/// The grain is what Real has left behind the point for all places in the tank and their images.
template <class Real>
std::vector<physics::Seam<Real>> seams_of(const Model& model) {
    std::vector<physics::Seam<Real>> seams;
    for (const PeriodicAxis& periodic : model.periodic) {
        const double reach = support(model);
        int exponent = 0;
        std::frexp(std::max(std::abs(periodic.low - reach), std::abs(periodic.high + reach)), &exponent);
        const double grain = std::ldexp(1.0, exponent - std::numeric_limits<Real>::digits);
        const auto on_grain = [grain](double x) { return static_cast<Real>(grain * std::rint(x / grain)); };
        seams.push_back({periodic.axis, on_grain(periodic.low), on_grain(periodic.length()), static_cast<Real>(grain)});
    }
    return seams;
}

template <class Real>
std::vector<physics::Border<Real>> borders_of(const Model& model) {
    std::vector<physics::Border<Real>> borders;
    for (const physics::Seam<Real>& seam : seams_of<Real>(model)) {
        const auto towards = [&](Real direction) { return with(physics::Vec3<Real>{}, seam.axis, direction); };
        borders.push_back({{towards(1), -seam.low}, seam.length});
        // What is at the very end is the image of what is at the other, and has none itself.
        borders.push_back({{towards(-1), seam.low + seam.length - seam.grain}, seam.length});
    }
    for (const Plane& plane : model.planes) {
        const auto& n = plane.normal;
        borders.push_back({{{static_cast<Real>(n.x()), static_cast<Real>(n.y()), static_cast<Real>(n.z())},
                            static_cast<Real>(plane.offset)},
                           Real(0)});
    }
    return borders;
}

Eigen::Vector3d gravity_on_walls(const Model& model) { return gravity_on_walls(model.parameters, model.periodic); }

Eigen::Vector3d gravity_on_walls(const SolverParameters& parameters, const std::vector<PeriodicAxis>& periodic) {
    Eigen::Vector3d gravity = parameters.gravity;
    for (const PeriodicAxis& one : periodic) gravity[one.axis] = 0;
    return gravity;
}

Eigen::Vector3d shortest_way(const Model& model, Eigen::Vector3d difference) {
    for (const PeriodicAxis& periodic : model.periodic) {
        double& along = difference[periodic.axis];
        along -= periodic.length() * std::round(along / periodic.length());
    }
    return difference;
}

template std::vector<physics::Seam<float>> seams_of(const Model&);
template std::vector<physics::Seam<double>> seams_of(const Model&);
template std::vector<physics::Border<float>> borders_of(const Model&);
template std::vector<physics::Border<double>> borders_of(const Model&);

}  // namespace natator
