#pragma once

#include "natator/evaluate.h"
#include "natator/model.h"

namespace natator {

/// Amplitude of the perturbations by which choose_start makes many starts of one, in rest distances of the fluid.
constexpr double start_amplitude = 1e-3;

/// Shifts every coordinate of the starting positions by amplitude (2 u - 1), u in [0, 1) being the upper 53 bits of
/// successive numbers of std::mt19937_64(seed), in the order of the particles and x, y, z: the same on every machine.
void perturb(const Perturbation& perturbation, Model& model);

}  // namespace natator
