#include "carried_weight.h"

#include <algorithm>
#include <cmath>

#include "borders.h"
#include "natator/error.h"
#include "physics/dfsph.h"
#include "scene/tank_ends.h"
#include "water_volumes.h"

namespace natator {
namespace {

constexpr double most_weight = 2;         ///< g H h^2 / s^2 of water of depth H that a pass holds up, in what it may take off
constexpr double solved_share = 2.0 / 3;  ///< of the depth that passes hold up: with all of it, water bobs at some depths
constexpr double least_supports = 1.5;    ///< of water that is not carried

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

/// `all`: the depth of the Model's water, likewise below.
bool may_carry(const Model& model, double all) {
    return model.scheme == Scheme::conserving && model.parameters.modifiedPressure && !weight_of(model).isZero(0) && all > 0;
}

double least_solved_of(const Model& model, double all) {
    return may_carry(model, all) ? std::min(all, least_supports * support(model)) : all;
}

/// H h^2 of water of depth H that all passes of a substep hold up, over what they may take off, length s^2.
double held_by_passes(const Model& model) {
    const SolverParameters& p = model.parameters;
    const int passes = physics::divergence_passes + p.numIterations;
    return most_weight * passes * p.fluidRestDistance * p.fluidRestDistance / weight_on_walls(model);
}

/// The depth at which longest_substep is the Model's.
double solved_of(const Model& model, double all) {
    const double least = least_solved_of(model, all);
    if (!(least < all)) return all;
    const SolverParameters& p = model.parameters;
    const double h = model.time_step / p.substeps, held = held_by_passes(model);
    const double shallow = physics::shallow_layers * p.fluidRestDistance;
    const double most = solved_share * held / h * std::min(physics::most_excess / h, fastest_expansion(p, shallow));
    return std::min(all, std::max(least, std::min(most, shallow)));
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

double weight_on_walls(const Model& model) {
    return gravity_on_walls(model).norm() * std::max(1.0, std::abs(model.parameters.buoyancy));
}

/// A pass holds up g H h^2/s^2 = most_weight times what it may take off of a density.
double longest_substep(const Model& model, double depth) {
    const SolverParameters& p = model.parameters;
    const double held = held_by_passes(model) / depth;
    return std::min(std::sqrt(held * physics::most_excess), held * fastest_expansion(p, depth));
}

double least_solved_depth(const Model& model) { return least_solved_of(model, depth(model)); }

double solved_depth(const Model& model) { return solved_of(model, depth(model)); }

template <class Real>
physics::CarriedWeight<Real> carried_weight(const Model& model) {
    const double all = depth(model);
    if (!may_carry(model, all)) return {};
    const Eigen::Vector3d gravity = weight_of(model);
    if (const auto reason = no_tank(gravity, model.planes, model.periodic))
        throw InputError("model: parameters.modifiedPressure = true: " + *reason);
    const double solved = solved_of(model, all);
    if (!(solved < all)) return {};
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
            .begin = static_cast<Real>(floor - volume / area + solved - reach / 2),
            .width = static_cast<Real>(reach)};
}

template physics::CarriedWeight<float> carried_weight(const Model&);
template physics::CarriedWeight<double> carried_weight(const Model&);

}  // namespace natator
