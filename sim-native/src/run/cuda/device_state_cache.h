#pragma once

#include <algorithm>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "natator/model.h"
#include "run/settled_state_key.h"
#include "solver/cuda/device_buffer.h"
#include "solver/cuda/list_room.h"

namespace natator::cuda {

template <class Real>
struct KeptStart {
    State<Real> state;
    ListRoom room{};  ///< of lists since it settled; none where that is always the same
};

/// The last settled starts on the devices, so that batches that begin alike settle once. For several threads.
template <class Real>
class DeviceStateCache {
public:
    /// Of a model on the current device; to be kept, if it is not too large for that.
    static std::optional<std::string> key_of(const Model& model, const Settling& settling) {
        if (model.particles() > max_particles) return std::nullopt;
        int device = 0;
        check(cudaGetDevice(&device), "current device");
        return std::to_string(device) + settled_state_key(model, settling, sizeof(Real));
    }
    std::optional<KeptStart<Real>> find(const std::optional<std::string>& key) const {
        const std::scoped_lock lock(mutex_);
        const auto found = key ? place_of(*key) : kept_.end();
        return found == kept_.end() ? std::nullopt : std::optional(found->second);
    }
    void keep(const std::optional<std::string>& key, const KeptStart<Real>& start) {
        const std::scoped_lock lock(mutex_);
        if (!key || place_of(*key) != kept_.end()) return;
        kept_.emplace_front(*key, start);
        if (kept_.size() > most) kept_.pop_back();
    }

private:
    auto place_of(const std::string& key) const {
        return std::ranges::find_if(kept_, [&](const auto& one) { return one.first == key; });
    }

    static constexpr int max_particles = 100'000;
    static constexpr std::size_t most = 16;
    mutable std::mutex mutex_;
    std::deque<std::pair<std::string, KeptStart<Real>>> kept_;
};

}  // namespace natator::cuda
