#pragma once

#include <optional>

#include "natator/settled_state_cache.h"
#include "settle.h"

namespace natator {

/// The start of the scene at rest: from the cache if there is one and it is there, else settled and kept there. Sets
/// `instability` if settling was unstable.
template <class Real>
State<Real> settled_start(const Model& model, const Settling& settling, Solver<Real>& solver,
                          const SettledStateCache* cache, std::optional<Instability>& instability) {
    const std::string by = solver.device();
    if (cache)
        if (auto found = cache->find<Real>(model, settling, by)) return *found;
    State<Real> state = initial_state<Real>(model);
    instability = settle(settling, solver, state);
    if (cache && !instability) cache->keep(model, settling, state, by);
    return state;
}

}  // namespace natator
