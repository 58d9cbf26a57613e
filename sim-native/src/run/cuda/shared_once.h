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

/// Values computed once by the first thread that asks for them, while other threads wait. Freed after their last use.
/// Thread-safe.
template <class Key, class Value>
class SharedOnce {
public:
    /// `needs` has each key as often as it will be released.
    explicit SharedOnce(const std::vector<Key>& needs) {
        for (const Key& key : needs) ++places_[key].needs;
    }

    /// Returns those of the keys that nobody has acquired yet, each once. The caller must publish or fail them.
    std::vector<Key> acquire(const std::vector<Key>& keys) {
        const std::scoped_lock lock(mutex_);
        std::vector<Key> acquired;
        for (const Key& key : keys)
            if (!std::exchange(places_.at(key).acquired, true)) acquired.push_back(key);
        return acquired;
    }
    /// Sets a value that the caller has acquired.
    void publish(const Key& key, Value value) {
        const std::scoped_lock lock(mutex_);
        places_.at(key).promise.set_value(std::make_shared<const Value>(std::move(value)));
    }
    /// Makes get() throw `reason` for those of the acquired keys that are not published.
    void fail(const std::vector<Key>& acquired, const std::exception_ptr& reason) {
        const std::scoped_lock lock(mutex_);
        for (const Key& key : acquired)
            if (Place& place = places_.at(key); !place.is_ready()) place.promise.set_exception(reason);
    }
    /// Waits for a value that some thread has acquired. Throws what that thread failed with.
    std::shared_ptr<const Value> get(const Key& key) {
        std::unique_lock lock(mutex_);
        const auto value = places_.at(key).value;
        lock.unlock();
        return value.get();
    }
    /// Ends one use of each of the keys.
    void release(const std::vector<Key>& keys) {
        const std::scoped_lock lock(mutex_);
        for (const Key& key : keys)
            if (const auto place = places_.find(key); --place->second.needs == 0) places_.erase(place);
    }

private:
    struct Place {
        int needs = 0;
        bool acquired = false;
        std::promise<std::shared_ptr<const Value>> promise;
        std::shared_future<std::shared_ptr<const Value>> value = promise.get_future().share();

        bool is_ready() const { return value.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }
    };

    std::mutex mutex_;
    std::map<Key, Place> places_;
};

}  // namespace natator::cuda
