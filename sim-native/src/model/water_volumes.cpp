#include "water_volumes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>

#include "boundaries.h"
#include "physics/dfsph.h"

namespace natator {
namespace {

double lattice_volume(double spacing, double radius) {
    const int n = static_cast<int>(std::ceil(radius / spacing));
    double sum = 0;
    for (int z = -n; z <= n; ++z)
        for (int y = -n; y <= n; ++y)
            for (int x = -n; x <= n; ++x) sum += wendland(spacing * std::sqrt(x * x + y * y + z * z), radius);
    return 1 / sum;
}

}  // namespace

double support(const Model& model) {
    return model.parameters.conserving.kernel_support * model.parameters.fluid_rest_distance;
}

double effect_radius(const Model& model) {
    return std::min(model.parameters.radius, support(model));
}

double wendland(double r, double radius) {
    const double q = r / radius;
    if (q >= 1) return 0;
    return 21 / (2 * std::numbers::pi * std::pow(radius, 3)) * std::pow(1 - q, 4) * (4 * q + 1);
}

std::vector<double> particle_volumes(const Model& model) {
    const SolverParameters& p = model.parameters;
    const double whole = lattice_volume(p.fluid_rest_distance, support(model));
    std::vector<double> volumes(model.particles(), whole);
    // Solids by group and cell of one rest distance: what is nearer than that is in the cells around.
    using GroupCell = std::array<std::int64_t, 4>;
    const auto cell_of = [&](int i, int dx, int dy, int dz) {
        const Eigen::Array3d at = (model.position[i] / p.fluid_rest_distance).array().floor();
        return GroupCell{model.phase[i] & phase::group_mask, std::int64_t(at.x()) + dx, std::int64_t(at.y()) + dy,
                         std::int64_t(at.z()) + dz};
    };
    std::map<GroupCell, std::vector<int>> cells;
    for (int i = 0; i < model.particles(); ++i)
        if (!model.is_fluid(i)) cells[cell_of(i, 0, 0, 0)].push_back(i);
    for (int i = 0; i < model.particles(); ++i) {
        if (model.is_fluid(i)) continue;
        double nearest = p.fluid_rest_distance;
        for (int place = 0; place < 27; ++place) {
            const auto found = cells.find(cell_of(i, place % 3 - 1, place / 3 % 3 - 1, place / 9 - 1));
            if (found == cells.end()) continue;
            for (const int other : found->second)
                if (other != i) nearest = std::min(nearest, (model.position[other] - model.position[i]).norm());
        }
        volumes[i] = whole * std::pow(nearest / p.fluid_rest_distance, 3);
    }
    return volumes;
}

double fluid_density(const Model& model, const std::vector<double>& volumes) {
    double mass = 0, volume = 0;
    for (int i = 0; i < model.particles(); ++i) {
        if (!model.is_fluid(i) || model.inverse_mass[i] == 0) continue;
        mass += 1 / model.inverse_mass[i];
        volume += volumes[i];
    }
    return volume > 0 ? mass / volume : 0;
}

double extent_of_fluid(const Model& model, const Eigen::Vector3d& direction) {
    double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
    for (int i = 0; i < model.particles(); ++i) {
        if (!model.is_fluid(i)) continue;
        low = std::min(low, direction.dot(model.position[i]));
        high = std::max(high, direction.dot(model.position[i]));
    }
    return std::max(high - low, 0.0);
}

double depth(const Model& model) {
    const Eigen::Vector3d down = gravity_on_walls(model);
    return down.isZero(0) ? 0 : extent_of_fluid(model, down.normalized());
}

double max_expansion_rate(const SolverParameters& parameters, double depth) {
    const double layers = std::max(depth / parameters.fluid_rest_distance, physics::shallow_layers);
    const double slower = std::pow(physics::shallow_layers / layers, 2);
    const double acceleration = std::min(std::max(parameters.max_acceleration / 10, parameters.gravity.norm()), 1e30);
    return std::max(physics::min_expansion, physics::expansion * slower) *
           std::sqrt(acceleration / parameters.fluid_rest_distance);
}

}  // namespace natator
