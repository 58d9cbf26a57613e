#pragma once

#include "natator/model.h"
#include "natator/state.h"

/// What the tests of the laws share: a box of fluid and its energies.
namespace natator::test {

inline constexpr double frame = 1.0 / 60;

/// A block of fluid of scheme `conserving` in a box that it fills but for the top: the thesis' lattice and parameters
/// without friction. `scale` shrinks the particles: 1/2 gives eight in the place of one, of an eighth of its mass.
inline Model fluid_column(int width, int layers, int substeps, int iterations, double scale = 1) {
    const double spacing = 0.09 * scale, margin = 0.05 * scale;
    Model model;
    model.scheme = Scheme::conserving;
    SolverParameters& p = model.parameters;
    for (double* length : {&p.radius, &p.solidRestDistance, &p.fluidRestDistance, &p.collisionDistance})
        *length *= scale;
    p.substeps = substeps;
    p.numIterations = iterations;
    p.dynamicFriction = 0;
    for (int y = 0; y < layers; ++y)
        for (int x = 0; x < width; ++x)
            for (int z = 0; z < width; ++z)
                model.position.emplace_back(margin + x * spacing, margin + y * spacing, margin + z * spacing);
    model.velocity.assign(model.position.size(), Eigen::Vector3d::Zero());
    model.inverse_mass.assign(model.position.size(), 1 / (scale * scale * scale));
    model.phase.assign(model.position.size(), phase::fluid | phase::self_collide);
    const double side = (width - 1) * spacing + 2 * margin;
    model.planes = {{{0, 1, 0}, 0}, {{1, 0, 0}, 0}, {{0, 0, 1}, 0}, {{-1, 0, 0}, side}, {{0, 0, -1}, side}};
    return model;
}

template <class Real>
double kinetic_energy(const Model& model, const State<Real>& state) {
    double energy = 0;
    for (int i = 0; i < model.particles(); ++i)
        if (model.inverse_mass[i] > 0)
            energy += 0.5 / model.inverse_mass[i] * static_cast<double>(state.velocity[i].squaredNorm());
    return energy;
}

template <class Real>
double total_energy(const Model& model, const State<Real>& state) {
    double energy = kinetic_energy(model, state);
    for (int i = 0; i < model.particles(); ++i)
        if (model.inverse_mass[i] > 0)
            energy -= model.parameters.gravity.dot(state.position[i].template cast<double>()) / model.inverse_mass[i];
    return energy;
}

}  // namespace natator::test
