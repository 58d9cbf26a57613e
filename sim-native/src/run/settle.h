#pragma once

#include <algorithm>
#include <optional>

#include "natator/scene.h"
#include "natator/solver.h"

namespace natator {

/// Brings the start to rest (thesis 2.3): velocities are zeroed after each update. Muscles are at rest; time stays 0.
/// `solver`: a Solver or a GpuSolver.
template <class AnySolver, class Real>
std::optional<Instability> settle(const Settling& settling, AnySolver& solver, State<Real>& state) {
    for (int i = 0; i < settling.updates; ++i) {
        if (auto instability = solver.update(state, settling.time_step, settling.substeps)) return instability;
        std::fill(state.velocity.begin(), state.velocity.end(), Vector3<Real>::Zero());
        state.time = 0;
    }
    return std::nullopt;
}

}  // namespace natator
