#pragma once

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <utility>
#include <vector>

namespace natator {

/// Does together what several threads ask for at the same time: the thread that comes first does the work of all that
/// wait by then, while they sleep (flat combining: Hendler, Incze, Shavit, Tzafrir 2010). For work that costs about as
/// much for many as for one, such as a launch on a GPU.
template <class Job>
class Combiner {
public:
    /// `work(jobs, place)` does 1 to `max_jobs` jobs, in the order in which they came; `places` such calls, numbered
    /// from 0, may be under way at a time.
    using Work = std::function<void(const std::vector<const Job*>& jobs, int place)>;
    Combiner(std::size_t max_jobs, int places, Work work) : max_jobs_(max_jobs), work_(std::move(work)) {
        for (int place = 0; place < places; ++place) free_.push_back(place);
    }

    /// Returns when the job is done. Throws what the work threw that it was part of.
    void run(const Job& job) {
        std::unique_lock lock(mutex_);
        Waiting own{&job};
        waiting_.push_back(&own);
        if (!free_.empty()) {
            hand_over(free_.back());
            free_.pop_back();
        }
        own.woken.wait(lock, [&] { return own.done || !own.group.empty(); });
        if (!own.done) lead(own.group, own.place, lock);
        if (own.error) std::rethrow_exception(own.error);
    }

private:
    struct Waiting {
        const Job* job;
        std::vector<Waiting*> group = {};  ///< whose jobs it is to do, its own first
        int place = 0;                     ///< and where
        bool done = false;
        std::exception_ptr error = {};
        std::condition_variable woken = {};
    };

    /// The thread that has waited longest is to do the jobs of those that wait.
    void hand_over(int place) {
        const auto end = waiting_.begin() + static_cast<std::ptrdiff_t>(std::min(waiting_.size(), max_jobs_));
        Waiting& first = *waiting_.front();
        first.group.assign(waiting_.begin(), end);
        first.place = place;
        waiting_.erase(waiting_.begin(), end);
        first.woken.notify_one();
    }

    void lead(const std::vector<Waiting*>& group, int place, std::unique_lock<std::mutex>& lock) {
        lock.unlock();
        std::vector<const Job*> jobs;
        for (const Waiting* one : group) jobs.push_back(one->job);
        std::exception_ptr error;
        try {
            work_(jobs, place);
        } catch (...) {
            error = std::current_exception();
        }
        lock.lock();
        for (Waiting* one : group) {
            one->done = true;
            one->error = error;
            one->woken.notify_one();
        }
        if (waiting_.empty())
            free_.push_back(place);
        else
            hand_over(place);
    }

    const std::size_t max_jobs_;
    const Work work_;
    std::mutex mutex_;
    std::deque<Waiting*> waiting_;  ///< none while a place is free
    std::vector<int> free_;
};

}  // namespace natator
