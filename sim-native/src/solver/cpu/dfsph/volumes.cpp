#include "volumes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace natator::cpu {
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
    return model.parameters.kernelSupport * model.parameters.fluidRestDistance;
}

double wendland(double r, double radius) {
    const double q = r / radius;
    if (q >= 1) return 0;
    return 21 / (2 * std::numbers::pi * std::pow(radius, 3)) * std::pow(1 - q, 4) * (4 * q + 1);
}

std::vector<double> particle_volumes(const Model& model) {
    const SolverParameters& p = model.parameters;
    const double whole = lattice_volume(p.fluidRestDistance, support(model));
    std::vector<double> volumes(model.particles(), whole);
    std::map<std::uint32_t, std::vector<int>> groups;
    for (int i = 0; i < model.particles(); ++i)
        if (!model.is_fluid(i)) groups[model.phase[i] & phase::group_mask].push_back(i);
    for (auto& [group, members] : groups) {
        // Sorted along x, so that those too far away are not looked at.
        std::sort(members.begin(), members.end(),
                  [&](int a, int b) { return model.position[a].x() < model.position[b].x(); });
        for (std::size_t k = 0; k < members.size(); ++k) {
            const Eigen::Vector3d& x = model.position[members[k]];
            double nearest = p.fluidRestDistance;
            const auto look_at = [&](std::size_t other) {
                const Eigen::Vector3d away = model.position[members[other]] - x;
                nearest = std::min(nearest, away.norm());
                return std::abs(away.x()) < nearest;
            };
            for (std::size_t other = k; other-- > 0 && look_at(other);) {}
            for (std::size_t other = k + 1; other < members.size() && look_at(other); ++other) {}
            volumes[members[k]] = whole * std::pow(nearest / p.fluidRestDistance, 3);
        }
    }
    return volumes;
}

}  // namespace natator::cpu
