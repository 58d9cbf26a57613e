#include "background_pressure.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "boundaries.h"
#include "natator/error.h"
#include "physics/dfsph.h"
#include "tank_ends.h"
#include "water_volumes.h"

namespace natator {
namespace {

constexpr double max_weight = 2;          ///< largest g H h^2 / s^2 that a pass supports, per density excess
constexpr double solved_share = 2.0 / 3;  ///< of the depth that passes support: all of it oscillates at some depths
constexpr double min_supports = 1.5;      ///< least depth that is left to the passes, in kernel supports

/// The axis along which gravity is largest; the floor is normal to it.
int upright_axis(const Eigen::Vector3d& gravity) {
    int axis = 0;
    gravity.cwiseAbs().maxCoeff(&axis);
    return axis;
}

const PeriodicAxis* periodic_along(int axis, const std::vector<PeriodicAxis>& periodic) {
    const auto found = std::find_if(periodic.begin(), periodic.end(), [axis](const PeriodicAxis& one) { return one.axis == axis; });
    return found == periodic.end() ? nullptr : &*found;
}

/// Gravity of the fluid along the axes that have ends, length/s^2.
Eigen::Vector3d weight_of(const Model& model) {
    return model.parameters.buoyancy * gravity_on_walls(model);
}

/// Whether weight of the water can be carried. `all`: depth of the water, length; the same in the functions below.
bool may_carry(const Model& model, double all) {
    return model.scheme == Scheme::conserving && model.parameters.conserving.modified_pressure &&
           !weight_of(model).isZero(0) && all > 0;
}

/// The depth of water that weighs as much as what gravity along the floor pushes against the walls, length: none of it
/// is carried.
double pushed_sideways(const Model& model) {
    const Eigen::Vector3d weight = weight_of(model);
    const int up = upright_axis(weight);
    double pushed = 0;
    for (int axis = 0; axis < 3; ++axis)
        if (axis != up) pushed += std::abs(weight[axis]) * extent_of_fluid(model, Eigen::Vector3d::Unit(axis));
    return pushed / weight.norm();
}

double min_solved_of(const Model& model, double all) {
    return may_carry(model, all) ? std::min(all, min_supports * support(model) + pushed_sideways(model)) : all;
}

/// Largest H h^2 that the pressure passes can support, per unit of the density excess that they may remove, length s^2.
double max_solved_depth(const Model& model) {
    const SolverParameters& p = model.parameters;
    const int passes = 1 + p.iterations;  // one on the divergence
    return max_weight * passes * p.fluid_rest_distance * p.fluid_rest_distance / weight_on_walls(model);
}

/// The depth D that is left to the passes, length: a share of the one at which max_substep is the Model's, within
/// limits.
double solved_of(const Model& model, double all) {
    if (!(min_solved_of(model, all) < all)) return all;
    const SolverParameters& p = model.parameters;
    const double h = model.time_step / p.substeps, least = min_supports * support(model);
    const double shallow = physics::shallow_layers * p.fluid_rest_distance;
    const double held = max_solved_depth(model) / h * std::min(physics::max_excess / h, max_expansion_rate(p, shallow));
    const double most = std::min(solved_share * held, held - pushed_sideways(model));
    return std::min(all, std::max(least, std::min(most, shallow)));
}

/// Length of the tank along an axis.
double extent(const Model& model, int axis) {
    if (const PeriodicAxis* const periodic = periodic_along(axis, model.periodic)) return periodic->length();
    const TankEnds ends = tank_ends(model.planes, axis);
    return ends.high.front() - ends.low.front();
}

/// How high above the floor the surface of all water is at rest, beside the solids that are held below it;
/// height_of(position) is that of a particle.
template <class HeightOf>
double surface_at_rest(const Model& model, double area, const HeightOf& height_of) {
    const std::vector<double> volumes = particle_volumes(model);
    const auto filled_to = [&](double surface) {
        double volume = 0;
        for (int i = 0; i < model.particles(); ++i)
            if (model.is_fluid(i) || (model.inverse_mass[i] == 0 && height_of(model.position[i]) < surface))
                volume += volumes[i];
        return volume / area;
    };
    double surface = 0;
    for (double higher = filled_to(surface); higher > surface; higher = filled_to(surface)) surface = higher;
    return surface;
}

/// Water far above its surface at rest weighs more than is left to the solver.
template <class HeightOf>
void refuse_heaped_water(const Model& model, double surface, const HeightOf& height_of) {
    double highest = 0;
    for (int i = 0; i < model.particles(); ++i)
        if (model.is_fluid(i)) highest = std::max(highest, height_of(model.position[i]));
    if (highest <= surface + support(model)) return;
    std::ostringstream text;
    text << "model: parameters.modifiedPressure = true: needs a tank that is full: water begins " << highest
         << " above the floor, and is " << surface << " deep at rest";
    throw InputError(text.str());
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

/// A pass supports g H h^2/s^2 = max_weight times the density excess that it may remove.
double max_substep(const Model& model, double depth) {
    const SolverParameters& p = model.parameters;
    const double held = max_solved_depth(model) / depth;
    return std::min(std::sqrt(held * physics::max_excess), held * max_expansion_rate(p, depth));
}

double min_solved_depth(const Model& model) {
    return min_solved_of(model, depth(model));
}

double solved_depth(const Model& model) {
    return solved_of(model, depth(model));
}

template <class Real>
physics::CarriedWeight<Real> background_pressure(const Model& model) {
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
    double area = 1;
    for (int axis = 0; axis < 3; ++axis)
        if (axis != up) area *= extent(model, axis);
    const double reach = support(model);
    const auto height_of = [&](const Eigen::Vector3d& x) { return floor - towards * x[up]; };
    const double surface = surface_at_rest(model, area, height_of);
    refuse_heaped_water(model, surface, height_of);
    const auto along = [&](double length) {
        physics::Vec3<Real> v{};
        (up == 0 ? v.x : up == 1 ? v.y : v.z) = static_cast<Real>(length);
        return v;
    };
    return {.gravity = along(gravity[up]),
            .down = along(towards),
            .begin = static_cast<Real>(floor - surface + solved - reach / 2),
            .width = static_cast<Real>(reach)};
}

template physics::CarriedWeight<float> background_pressure(const Model&);
template physics::CarriedWeight<double> background_pressure(const Model&);

}  // namespace natator
