#pragma once

#include <optional>
#include <string>

#include "natator/limits.h"
#include "natator/settled_state_cache.h"
#include "settle.h"

namespace natator {

/// Where the settled starts of a scene are kept, on whatever they are computed: nowhere if nobody asks for it, if there
/// is nothing to settle, or if they are too large for that.
class KeptStarts {
public:
    /// `cache` may be null. `by`: what computes them, if its bits are its own.
    KeptStarts(const SettledStateCache* cache, const Settling& settling, std::string by = "")
        : cache_(settling.updates > 0 ? cache : nullptr), settling_(settling), by_(std::move(by)) {}

    template <class Real>
    std::optional<State<Real>> find(const Model& model) const {
        return keeps(model) ? cache_->find<Real>(model, settling_, by_) : std::nullopt;
    }
    template <class Real>
    void keep(const Model& model, const State<Real>& settled) const {
        if (keeps(model)) cache_->keep(model, settling_, settled, by_);
    }

private:
    bool keeps(const Model& model) const { return cache_ && model.particles() <= limits::cached_particles; }

    const SettledStateCache* cache_;
    Settling settling_;
    std::string by_;
};

/// The start of the scene at rest: from the cache if there is one and it is there, else settled and kept there. Sets
/// `instability` if settling was unstable.
template <class Real>
State<Real> settled_start(const Model& model, const Settling& settling, Solver<Real>& solver,
                          const SettledStateCache* cache, std::optional<Instability>& instability) {
    const KeptStarts starts(cache, settling);
    if (auto found = starts.find<Real>(model)) return *found;
    State<Real> state = initial_state<Real>(model);
    instability = settle(settling, solver, state);
    if (!instability) starts.keep(model, state);
    return state;
}

}  // namespace natator
