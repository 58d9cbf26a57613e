#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace natator {

/// A thread for so many calls of work that takes some ten microseconds, about what a thread takes to wake.
constexpr std::size_t short_calls = 16;

/// Calls work(0) .. work(count - 1) on as many threads as there are processors, or so many `per_processor` where the
/// work waits for something else, at most `max_threads`; one is that of the caller, the others stay for the next call.
/// Throws what one of the calls threw, after all have ended.
void side_by_side(std::size_t count, const std::function<void(std::size_t)>& work, std::size_t max_threads = SIZE_MAX,
                  std::size_t per_processor = 1);

}  // namespace natator
