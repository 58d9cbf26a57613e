#pragma once

#include <chrono>
#include <exception>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace natator::cuda {

/// Values that several threads need: each is made by the first that needs it, while others that do wait, and is forgotten with
/// the last need. For several threads.
template <class Key, class Value>
class SharedOnce {
public:
    /// Each key as often as it is needed.
    explicit SharedOnce(const std::vector<Key>& needs) {
        for (const Key& key : needs) ++places_[key].needs;
    }

    /// Of the keys those that nobody has claimed, each once: to be given, or else failed, by the caller.
    std::vector<Key> claim(const std::vector<Key>& keys) {
        const std::scoped_lock lock(mutex_);
        std::vector<Key> claimed;
        for (const Key& key : keys)
            if (!std::exchange(places_.at(key).claimed, true)) claimed.push_back(key);
        return claimed;
    }
    void give(const Key& key, Value value) {
        const std::scoped_lock lock(mutex_);
        places_.at(key).promise.set_value(std::make_shared<const Value>(std::move(value)));
    }
    /// Says to all that wait why those that were not given will not come.
    void fail(const std::vector<Key>& claimed, const std::exception_ptr& reason) {
        const std::scoped_lock lock(mutex_);
        for (const Key& key : claimed)
            if (Place& place = places_.at(key); !place.is_given()) place.promise.set_exception(reason);
    }
    /// Waits for what somebody has claimed. Throws what that one failed with.
    std::shared_ptr<const Value> of(const Key& key) {
        std::unique_lock lock(mutex_);
        const auto value = places_.at(key).value;
        lock.unlock();
        return value.get();
    }
    /// These are needed no more, each as often as it stands here.
    void leave(const std::vector<Key>& keys) {
        const std::scoped_lock lock(mutex_);
        for (const Key& key : keys)
            if (const auto place = places_.find(key); --place->second.needs == 0) places_.erase(place);
    }

private:
    struct Place {
        int needs = 0;
        bool claimed = false;
        std::promise<std::shared_ptr<const Value>> promise;
        std::shared_future<std::shared_ptr<const Value>> value = promise.get_future().share();

        bool is_given() const { return value.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }
    };

    std::mutex mutex_;
    std::map<Key, Place> places_;
};

}  // namespace natator::cuda
