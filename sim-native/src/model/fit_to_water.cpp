#include "fit_to_water.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "borders.h"
#include "carried_weight.h"
#include "physics/dfsph.h"
#include "water_volumes.h"

namespace natator {
namespace {

constexpr double least_density = 0.02;  ///< of a solid, in units of the water's
constexpr double longest_fall = 0.1;    ///< from rest in a substep, in rest distances
constexpr double most_weight = 2;       ///< g H h^2 / s^2 of water of solved_depth H that a pass holds up, in what it may take off

void raise_light_solids(Model& model) {
    const std::vector<double> volumes = particle_volumes(model);
    const double density = fluid_density(model, volumes);
    if (!(density > 0)) return;
    for (int i = 0; i < model.particles(); ++i)
        if (!model.is_fluid(i))
            model.inverse_mass[i] = std::min(model.inverse_mass[i], 1 / (least_density * density * volumes[i]));
}

void raise_substeps(Model& model) {
    SolverParameters& p = model.parameters;
    const double weight = std::max(1.0, std::abs(p.buoyancy)), gravity = p.gravity.norm() * weight;
    if (!(gravity > 0)) return;
    const double spacing = p.fluidRestDistance;
    const double passes = physics::divergence_passes + p.numIterations;
    double longest = std::sqrt(longest_fall * spacing / gravity);
    if (const Eigen::Vector3d down = gravity_on_walls(model); !down.isZero(0)) {
        const double deep = solved_depth(model), height = std::max(deep, spacing);
        const double held = most_weight * passes * spacing * spacing / (down.norm() * weight * height);
        longest = std::min({longest, std::sqrt(held * physics::most_excess), held * fastest_expansion(p, deep)});
    }
    constexpr double rounding = 1e-9;
    p.substeps = std::max(p.substeps, static_cast<int>(std::ceil(model.time_step / longest * (1 - rounding))));
}

}  // namespace

void fit_to_water(Model& model) {
    raise_light_solids(model);
    raise_substeps(model);
}

}  // namespace natator
