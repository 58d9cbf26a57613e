#pragma once

#include "natator/model.h"

/// Energies of what is not held, mass length^2/s^2.
namespace natator::test {

template <class Real>
double kinetic_energy(const Model& model, const State<Real>& state) {
    double energy = 0;
    for (int i = 0; i < model.particles(); ++i)
        if (model.inverse_mass[i] > 0)
            energy += 0.5 / model.inverse_mass[i] * static_cast<double>(state.velocity[i].squaredNorm());
    return energy;
}

/// The same and that of the heights.
template <class Real>
double total_energy(const Model& model, const State<Real>& state) {
    double energy = kinetic_energy(model, state);
    for (int i = 0; i < model.particles(); ++i)
        if (model.inverse_mass[i] > 0)
            energy -= model.parameters.gravity.dot(state.position[i].template cast<double>()) / model.inverse_mass[i];
    return energy;
}

}  // namespace natator::test
