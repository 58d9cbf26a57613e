#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <functional>
#include <future>
#include <thread>
#include <vector>

namespace natator {

/// A thread for so many calls of work that takes some ten microseconds, about what a thread takes to start.
constexpr std::size_t short_calls = 16;

/// Calls work(0) .. work(count - 1) on as many threads as there are processors, or so many `per_processor` where the
/// work waits for something else, at most `max_threads`; the last is that of the caller. Throws what one of the calls
/// threw, after all threads have ended.
inline void side_by_side(std::size_t count, const std::function<void(std::size_t)>& work,
                         std::size_t max_threads = SIZE_MAX, std::size_t per_processor = 1) {
    const std::size_t threads = per_processor * std::max(1u, std::thread::hardware_concurrency());
    std::atomic<std::size_t> next = 0;
    std::vector<std::future<void>> workers;
    const auto run = [&] {
        for (std::size_t one = next++; one < count; one = next++) work(one);
    };
    for (std::size_t k = 1; k < std::min({count, threads, max_threads}); ++k)
        workers.push_back(std::async(std::launch::async, run));
    run();
    for (std::future<void>& worker : workers) worker.get();  // if this throws, the futures left wait for their threads
}

}  // namespace natator
