#include "fit_to_water.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "background_pressure.h"
#include "physics/dfsph.h"
#include "water_volumes.h"

namespace natator {
namespace {

constexpr double min_density = 0.02;  ///< of a solid, in units of the water's
constexpr double max_fall = 0.1;      ///< from rest in a substep, in rest distances

void raise_light_solids(Model& model) {
    const std::vector<double> volumes = particle_volumes(model);
    const double density = fluid_density(model, volumes);
    if (!(density > 0)) return;
    for (int i = 0; i < model.particles(); ++i)
        if (!model.is_fluid(i))
            model.inverse_mass[i] = std::min(model.inverse_mass[i], 1 / (min_density * density * volumes[i]));
}

void raise_substeps(Model& model) {
    SolverParameters& p = model.parameters;
    const double gravity = p.gravity.norm() * std::max(1.0, std::abs(p.buoyancy));
    if (!(gravity > 0)) return;
    const double spacing = p.fluid_rest_distance;
    double longest = std::sqrt(max_fall * spacing / gravity);
    if (weight_on_walls(model) > 0)
        longest = std::min(longest, max_substep(model, std::max(min_solved_depth(model), spacing)));
    constexpr double rounding = 1e-9;
    p.substeps = std::max(p.substeps, static_cast<int>(std::ceil(model.time_step / longest * (1 - rounding))));
}

}  // namespace

void fit_to_water(Model& model) {
    raise_light_solids(model);
    raise_substeps(model);
}

}  // namespace natator
