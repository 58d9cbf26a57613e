#pragma once

#include <optional>

#include "natator/limits.h"
#include "natator/settled_state_cache.h"
#include "settle.h"

namespace natator {

/// The start of the scene at rest: from the cache if there is one and it is there, else settled and kept there. Sets
/// `instability` if settling was unstable. What a GPU settles has bits of its own, and is not kept.
template <class Real>
State<Real> settled_start(const Model& model, const Settling& settling, Solver<Real>& solver,
                          const SettledStateCache* starts, std::optional<Instability>& instability) {
    if (settling.updates == 0 || solver.on_gpu() || model.particles() > limits::cached_particles) starts = nullptr;
    if (starts)
        if (auto found = starts->find<Real>(model, settling)) return *found;
    State<Real> state = initial_state<Real>(model);
    instability = settle(settling, solver, state);
    if (starts && !instability) starts->keep(model, settling, state);
    return state;
}

}  // namespace natator
