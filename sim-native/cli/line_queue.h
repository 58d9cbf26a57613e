#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <istream>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace natator::cli {

/// Lines of a stream as they come in, read by a thread of its own. Must not outlive the stream; ends with it.
class LineQueue {
public:
    explicit LineQueue(std::istream& input);
    ~LineQueue();

    /// Waits for a line, then takes all that have come, at most `most`, as soon as none comes for `lull`. Empty only at
    /// the end of the stream.
    std::vector<std::string> take(std::size_t most, std::chrono::milliseconds lull);

private:
    void read(std::istream& input);

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::string> lines_;
    bool ended_ = false;
    std::thread reader_;
};

}  // namespace natator::cli
