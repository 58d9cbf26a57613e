#include "line_queue.h"

#include <algorithm>
#include <array>

namespace natator::cli {
LineQueue::LineQueue(Limits limits) : limits_(limits), reader_([this] { read(); }) {}

LineQueue::~LineQueue() {
    {
        const std::lock_guard lock(mutex_);
        closing_ = true;
    }
    room_.notify_one();
    input_.stop();
    reader_.join();
}

void LineQueue::read() {
    std::array<char, 65536> buffer;
    std::string line;
    bool open = true;
    while (open) {
        const std::size_t count = input_.read(buffer.data(), buffer.size());
        if (count == 0) break;
        const char* at = buffer.data();
        const char* const end = at + count;
        while (open && at != end) {
            const char* const stop = std::find(at, end, '\n');
            const auto more = static_cast<std::size_t>(stop - at);
            if (line.size() <= limits_.bytes)
                line.append(at, more > limits_.bytes - line.size() ? limits_.bytes - line.size() + 1 : more);
            at = stop;
            if (at == end) break;
            ++at;
            open = add_line(std::move(line));
            line.clear();
        }
    }
    if (open && !line.empty()) add_line(std::move(line));
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_one();
}

/// False when the queue is being destroyed.
bool LineQueue::add_line(std::string line) {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [this] { return closing_ || !full(); });
    if (closing_) return false;
    bytes_ += line.size();
    lines_.push_back(std::move(line));
    changed_.notify_one();
    return true;
}

std::vector<std::string> LineQueue::take(std::size_t max_lines, std::chrono::milliseconds lull) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return ended_ || !lines_.empty(); });
    std::size_t seen = 0;
    while (!ended_ && lines_.size() < max_lines && lines_.size() > seen && !full()) {
        seen = lines_.size();
        changed_.wait_for(lock, lull, [&] { return ended_ || lines_.size() > seen; });
    }
    return take_locked(max_lines);
}

std::vector<std::string> LineQueue::take_waiting() {
    const std::lock_guard lock(mutex_);
    return take_locked(lines_.size());
}

void LineQueue::wait_until(Clock::time_point time) {
    std::unique_lock lock(mutex_);
    changed_.wait_until(lock, time, [this] { return ended_ || !lines_.empty(); });
}

void LineQueue::wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return ended_ || !lines_.empty(); });
}

bool LineQueue::exhausted() {
    const std::lock_guard lock(mutex_);
    return ended_ && lines_.empty();
}

std::vector<std::string> LineQueue::take_locked(std::size_t max_lines) {
    std::vector<std::string> taken;
    while (!lines_.empty() && taken.size() < max_lines) {
        bytes_ -= lines_.front().size();
        taken.push_back(std::move(lines_.front()));
        lines_.pop_front();
    }
    room_.notify_one();
    return taken;
}

}  // namespace natator::cli
