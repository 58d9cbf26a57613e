#pragma once

#include <algorithm>
#include <cmath>

#include "law_models.h"
#include "model/boundaries.h"
#include "model/water_volumes.h"

/// Models of periodic tanks that tests share.
namespace natator::test {

/// The walls across these axes are no more, and the tank goes on instead.
inline Model made_periodic(Model model, const std::vector<int>& axes) {
    for (const int axis : axes) {
        PeriodicAxis periodic{axis, 0, 0};
        for (const Plane& plane : model.planes)
            if (plane.normal[axis] == 1)
                periodic.low = -plane.offset;
            else if (plane.normal[axis] == -1)
                periodic.high = plane.offset;
        std::erase_if(model.planes, [axis](const Plane& plane) { return std::abs(plane.normal[axis]) == 1; });
        model.periodic.push_back(periodic);
    }
    return model;
}

/// Everything further on along a periodic axis: water comes in at the other end, solids are where they then are.
inline Model moved_on(Model model, std::size_t periodic, double way) {
    const PeriodicAxis& axis = model.periodic[periodic];
    for (int i = 0; i < model.particles(); ++i) {
        double& x = model.position[i][axis.axis];
        x += way;
        if (model.is_fluid(i)) x -= axis.length() * std::floor((x - axis.low) / axis.length());
    }
    return model;
}

/// Largest distance between places of `b` and those of `a` moved on by `way`, through the ends too.
template <class Real>
double max_difference(const Model& model, const State<Real>& a, const State<Real>& b, const Eigen::Vector3d& way) {
    double largest = 0;
    for (std::size_t i = 0; i < a.position.size(); ++i) {
        const Eigen::Vector3d difference = (b.position[i] - a.position[i]).template cast<double>() - way;
        const double distance = minimum_image(model, difference).norm();
        if (!(distance <= largest)) largest = distance;  // also for NaN
    }
    return largest;
}

/// Water of unequal masses that shears and swells, so that all of its forces act: viscous, in a tank with a floor.
inline Model stirred_periodic_water(const std::vector<int>& axes) {
    Model model = made_periodic(box_of_water({8, 6, 7}), axes);
    model.parameters.conserving.kinematic_viscosity = 0.01;
    for (int i = 0; i < model.particles(); ++i) {
        const Eigen::Vector3d& x = model.position[i];
        if (i % 3 == 0) model.inverse_mass[i] = 0.5;
        model.velocity[i] = {std::sin(7 * x.z()), std::cos(5 * x.x()), std::sin(8 * x.x() + 3 * x.y())};
    }
    return model;
}

/// Still water around a rigid cube that flies along x and turns; its middle is at `x`. Weightless, all open to the
/// sides.
inline Model cube_through_periodic_water(double x) {
    Model model = made_periodic(cube_in_water(1.2, 1), {0, 2});
    model.parameters.gravity.setZero();
    model.parameters.conserving.kinematic_viscosity = 0.01;
    const Eigen::Vector3d middle(0.55, 0.55, 0.55);
    for (const int i : model.clusters.front().particles) {
        const Eigen::Vector3d arm = model.position[i] - middle;
        model.velocity[i] = Eigen::Vector3d(1, 0, 0.3) + Eigen::Vector3d(0, 1, 2).cross(arm);
    }
    return moved_on(model, 0, x - middle.x());
}

}  // namespace natator::test
