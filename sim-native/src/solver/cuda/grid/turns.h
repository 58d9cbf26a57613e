#pragma once

#include <condition_variable>
#include <mutex>

namespace natator::cuda {

/// Some at a time, in the order in which they ask: all that go on side by side come equally far.
class Turns {
public:
    explicit Turns(unsigned at_a_time) : open_(at_a_time) {}

    /// One of the turns as long as this lives, if there are any.
    class Turn {
    public:
        explicit Turn(Turns* turns) : turns_(turns) {
            if (turns_) turns_->begin();
        }
        Turn(const Turn&) = delete;
        Turn& operator=(const Turn&) = delete;
        ~Turn() {
            if (turns_) turns_->end();
        }

    private:
        Turns* turns_;
    };

private:
    void begin() {
        std::unique_lock lock(mutex_);
        const auto own = asked_++;
        changed_.wait(lock, [&] { return own < open_; });
    }
    void end() {
        {
            const std::lock_guard lock(mutex_);
            ++open_;
        }
        changed_.notify_all();
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    unsigned long long asked_ = 0, open_;
};

/// What GridRunners of one GPU wait for: with more at a time they are in each other's way.
struct TurnsOfGpu {
    static constexpr int at_a_time = 2;
    Turns preparing{at_a_time}, computing{at_a_time};
};

}  // namespace natator::cuda
