#pragma once

#include <cstdint>

#include "natator/model.h"
#include "natator/state.h"

/// What is read off a State. Nothing here writes to it. What takes a Model throws InputError if the State has not as many
/// particles. Real is float or double.
namespace natator {

/// Mean x over the body's particles, length (thesis 2.6); 0 without a body.
template <class Real>
double mean_x(const Body& body, const State<Real>& state);

/// Whether any body particle is within collision_distance of any plane. The solver leaves a particle that it pushes out
/// of a plane at that distance to within rounding, so rounding (1e-6 of the plane's offset + 1) counts as touching.
template <class Real>
bool touches_plane(const Model& model, const State<Real>& state);

/// FNV-1a (64 bits) over the bytes of all positions, then all velocities, each as x, y, z, lowest
/// byte of each number first.
template <class Real>
std::uint64_t state_hash(const State<Real>& state);

}  // namespace natator
