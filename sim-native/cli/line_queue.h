#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "base/system.h"

namespace natator::cli {

/// Lines of standard input as they come in, read by a thread of its own, which ends with the stream or with the queue.
class LineQueue {
public:
    using Clock = std::chrono::steady_clock;

    struct Limits {
        std::size_t lines = SIZE_MAX;          ///< that wait; no more is read while they do
        std::size_t bytes = SIZE_MAX;          ///< of a line; a longer one is cut to one byte more
        std::size_t waiting_bytes = SIZE_MAX;  ///< of all lines that wait; the last one may go beyond
        /// of a message: 4 of the letters below, 32 bits that are the number of bytes behind them, and these. It stands
        /// in place of a line, and is cut as one.
        std::size_t message_bytes = 0;
        std::vector<std::string> letters{};  ///< that messages begin with; no line may
    };

    /// Throws std::system_error when there is no thread to be had.
    explicit LineQueue(Limits limits);
    ~LineQueue();
    LineQueue(const LineQueue&) = delete;
    LineQueue& operator=(const LineQueue&) = delete;

    /// Waits for a line, then takes all that have come, at most `most`, as soon as none comes for `lull`. Empty only at
    /// the end of the stream.
    std::vector<std::string> take(std::size_t max_lines, std::chrono::milliseconds lull);

    /// Takes what has come, without waiting.
    std::vector<std::string> take_waiting();
    /// Waits for a line or the end of the stream, at most until `time`.
    void wait_until(Clock::time_point time);
    void wait();
    /// True if the stream has ended and all its lines are taken.
    bool exhausted();
    /// Throws InputError if it ended because it could not be read.
    void check_end() const;

private:
    void read();
    bool take_bytes(std::string_view bytes);
    bool add_line(std::string line);
    bool full() const { return lines_.size() >= limits_.lines || bytes_ >= limits_.waiting_bytes; }
    std::vector<std::string> take_locked(std::size_t max_lines);

    system::Input input_;
    const Limits limits_;

    std::string line_;            ///< that is being read
    std::size_t of_message_ = 0;  ///< bytes that it still has to have, as a message

    std::mutex mutex_;
    std::condition_variable changed_, room_;
    std::deque<std::string> lines_;
    std::size_t bytes_ = 0;  ///< of lines_
    bool ended_ = false;
    bool closing_ = false;
    std::thread reader_;
};

}  // namespace natator::cli
