#include "line_queue.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <system_error>
#include <utility>

#include "natator/error.h"

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
    bool open = true;
    while (open) {
        const std::size_t count = input_.read(buffer.data(), buffer.size());
        if (count == 0) break;
        open = take_bytes({buffer.data(), count});
        changed_.notify_one();  // lines that came together are taken together
    }
    if (open && !line_.empty()) add_line(std::move(line_));
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_one();
}

/// False when the queue is being destroyed.
bool LineQueue::take_bytes(std::string_view bytes) {
    constexpr std::size_t letters = 4, head = letters + sizeof(std::uint32_t);
    while (!bytes.empty()) {
        if (of_message_ > 0) {
            const std::size_t size = std::min(of_message_, bytes.size());
            if (line_.size() < head || line_.size() - head <= limits_.message_bytes) line_ += bytes.substr(0, size);
            bytes.remove_prefix(size);
            of_message_ -= size;
            if (of_message_ > 0) return true;
            if (line_.size() == head) {  // the head is there
                std::uint32_t length = 0;
                std::memcpy(&length, line_.data() + letters, sizeof length);
                of_message_ = length;
            }
            if (of_message_ == 0 && !add_line(std::exchange(line_, {}))) return false;
            continue;
        }
        if (line_.size() < letters && !limits_.letters.empty()) {  // byte by byte, for it may become a message
            line_ += bytes.front();
            bytes.remove_prefix(1);
            if (std::find(limits_.letters.begin(), limits_.letters.end(), line_) != limits_.letters.end())
                of_message_ = head - letters;
            if (line_.back() != '\n') continue;
            line_.pop_back();
        } else {
            const std::size_t end = bytes.find('\n'), size = std::min(end, bytes.size());
            if (line_.size() <= limits_.bytes)
                line_ += bytes.substr(0, std::min(size, limits_.bytes + 1 - line_.size()));
            bytes.remove_prefix(size);
            if (bytes.empty()) return true;
            bytes.remove_prefix(1);
        }
        if (!add_line(std::exchange(line_, {}))) return false;
    }
    return true;
}

/// False when the queue is being destroyed.
bool LineQueue::add_line(std::string line) {
    std::unique_lock lock(mutex_);
    if (full()) changed_.notify_one();
    room_.wait(lock, [this] { return closing_ || !full(); });
    if (closing_) return false;
    bytes_ += line.size();
    lines_.push_back(std::move(line));
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

void LineQueue::check_end() const {
    if (const int error = input_.error())
        throw InputError("standard input: cannot be read (" + std::generic_category().message(error) +
                         "); must be a file, a pipe or a terminal");
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
