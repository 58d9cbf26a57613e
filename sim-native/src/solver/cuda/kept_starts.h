#pragma once

#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "evaluate/settled_state_key.h"
#include "natator/state.h"
#include "solver/cuda/device_buffer.h"

namespace natator::cuda {

template <class Real>
struct KeptStart {
    State<Real> state;
    int neighbours = 0;  ///< that lists have room for since it settled; 0 where that is always the same
};

/// The last settled starts on the devices, so that batches that begin alike settle once. For several threads.
template <class Real>
class KeptStarts {
public:
    /// Of a model on the current device; to be kept, if it is not too large for that.
    static std::optional<std::string> key_of(const Model& model, const Settling& settling) {
        if (model.particles() > most_particles) return std::nullopt;
        int device = 0;
        check(cudaGetDevice(&device), "current device");
        return std::to_string(device) + settled_state_key(model, settling, sizeof(Real));
    }
    std::optional<KeptStart<Real>> find(const std::optional<std::string>& key) const {
        const std::scoped_lock lock(mutex_);
        for (const auto& [known, start] : kept_)
            if (key && known == *key) return start;
        return std::nullopt;
    }
    void keep(const std::optional<std::string>& key, const KeptStart<Real>& start) {
        if (!key || find(key)) return;
        const std::scoped_lock lock(mutex_);
        kept_.emplace_front(*key, start);
        if (kept_.size() > most) kept_.pop_back();
    }

private:
    static constexpr int most_particles = 100'000;
    static constexpr std::size_t most = 16;
    mutable std::mutex mutex_;
    std::deque<std::pair<std::string, KeptStart<Real>>> kept_;
};

}  // namespace natator::cuda
