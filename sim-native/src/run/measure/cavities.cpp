#include <algorithm>
#include <cmath>
#include <string>

#include "model/check_model.h"
#include "model/water_volumes.h"
#include "natator/error.h"
#include "natator/measure.h"
#include "physics/dfsph.h"

namespace natator {

template <class Real>
std::optional<double> cavities(const Model& model, const State<Real>& state, const std::vector<Real>& densities) {
    constexpr double below_surface = 0.95;  // of the water
    const double gravity = model.parameters.gravity.norm();
    if (model.body.particles.empty() || gravity == 0) return std::nullopt;
    check_places(model, state);
    if (densities.size() != model.position.size())
        throw InputError("densities has length " + std::to_string(densities.size()) + ": must have length " +
                         std::to_string(model.particles()));
    const Eigen::Vector3d down = model.parameters.gravity / gravity;
    const auto depth = [&](int i) { return down.dot(state.position[i].template cast<double>()); };
    std::vector<double> depths;
    for (int i = 0; i < model.particles(); ++i)
        if (model.is_fluid(i)) depths.push_back(depth(i));
    if (depths.empty()) return std::nullopt;
    const auto surface =
        depths.begin() + static_cast<std::ptrdiff_t>((1 - below_surface) * static_cast<double>(depths.size()));
    std::nth_element(depths.begin(), surface, depths.end());
    const double deep = *surface + support(model);
    const std::vector<double> volumes = particle_volumes(model);
    double torn = 0, body = 0;
    for (int i = 0; i < model.particles(); ++i)
        if (model.is_fluid(i) && depth(i) > deep && static_cast<double>(densities[i]) < physics::wet_density)
            torn += volumes[i];
    for (const int particle : model.body.particles) body += volumes[particle];
    return torn / body;
}

template std::optional<double> cavities(const Model&, const State<float>&, const std::vector<float>&);
template std::optional<double> cavities(const Model&, const State<double>&, const std::vector<double>&);

}  // namespace natator
