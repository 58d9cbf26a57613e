#include "side_by_side.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>

namespace natator {
namespace {

/// Calls of a caller that others may make for it.
struct Calls {
    std::size_t count;
    const std::function<void(std::size_t)>& work;
    std::atomic<std::size_t> next = 0;
    // Under the mutex of the Helpers:
    std::size_t wanted = 0;  ///< helpers that may still begin
    std::size_t inside = 0;  ///< that have begun
    std::exception_ptr thrown{};
    std::condition_variable left{};

    /// Those that nobody has made, until one throws; returns what it threw.
    std::exception_ptr make() {
        try {
            for (std::size_t one = next++; one < count; one = next++) work(one);
        } catch (...) {
            return std::current_exception();
        }
        return {};
    }
};

/// Threads that help whoever has calls to make, and sleep in between. There are as many as ever helped at a time.
class Helpers {
public:
    /// Makes them, with the caller; returns what one of them threw.
    std::exception_ptr help(Calls& calls) {
        std::unique_lock lock(mutex_);
        waiting_.push_back(&calls);
        wanted_ += calls.wanted;
        try {
            for (; idle_ < wanted_; ++idle_) std::thread([this] { run(); }).detach();
        } catch (const std::system_error&) {  // there are no more to be had: fewer do the same
        }
        for (std::size_t k = 0; k < calls.wanted; ++k) more_.notify_one();
        lock.unlock();
        const std::exception_ptr own = calls.make();
        lock.lock();
        wanted_ -= calls.wanted;
        std::erase(waiting_, &calls);
        calls.wanted = 0;
        calls.left.wait(lock, [&] { return calls.inside == 0; });
        return own ? own : calls.thrown;
    }

private:
    void run() {
        for (std::unique_lock lock(mutex_);;) {
            more_.wait(lock, [this] { return !waiting_.empty(); });
            --idle_, --wanted_;
            Calls& calls = *waiting_.front();
            if (--calls.wanted == 0) waiting_.pop_front();
            ++calls.inside;
            lock.unlock();
            const std::exception_ptr thrown = calls.make();
            lock.lock();
            if (thrown) calls.thrown = thrown;
            if (--calls.inside == 0) calls.left.notify_one();
            ++idle_;
        }
    }

    std::mutex mutex_;
    std::condition_variable more_;
    std::deque<Calls*> waiting_;
    std::size_t wanted_ = 0;  ///< of all that wait
    std::size_t idle_ = 0;    ///< threads, those included that have not yet begun
};

}  // namespace

void side_by_side(std::size_t count, const std::function<void(std::size_t)>& work, std::size_t max_threads,
                  std::size_t per_processor) {
    static Helpers& helpers = *new Helpers;  // never destroyed: its threads sleep in it until the process ends
    const std::size_t threads = per_processor * std::max(1u, std::thread::hardware_concurrency());
    Calls calls{.count = count, .work = work};
    const std::size_t most = std::min({count, threads, max_threads});
    if (most > 1) calls.wanted = most - 1;
    if (const std::exception_ptr thrown = most > 1 ? helpers.help(calls) : calls.make()) std::rethrow_exception(thrown);
}

}  // namespace natator
