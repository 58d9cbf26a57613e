#include "line_queue.h"

namespace natator::cli {

LineQueue::LineQueue(std::istream& input) : reader_([this, &input] { read(input); }) {}

LineQueue::~LineQueue() {
    reader_.join();
}

void LineQueue::read(std::istream& input) {
    std::string line;
    while (std::getline(input, line)) {
        const std::lock_guard lock(mutex_);
        lines_.push_back(std::move(line));
        changed_.notify_one();
    }
    const std::lock_guard lock(mutex_);
    ended_ = true;
    changed_.notify_one();
}

std::vector<std::string> LineQueue::take(std::size_t most, std::chrono::milliseconds lull) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return ended_ || !lines_.empty(); });
    std::size_t seen = 0;
    while (!ended_ && lines_.size() < most && lines_.size() > seen) {
        seen = lines_.size();
        changed_.wait_for(lock, lull, [&] { return ended_ || lines_.size() > seen; });
    }
    std::vector<std::string> taken;
    while (!lines_.empty() && taken.size() < most) {
        taken.push_back(std::move(lines_.front()));
        lines_.pop_front();
    }
    return taken;
}

}  // namespace natator::cli
