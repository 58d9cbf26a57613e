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

    void make() {
        for (std::size_t one = next++; one < count; one = next++) work(one);
    }
};

/// Threads that help whoever has calls to make, and sleep in between. There are as many as ever helped at a time.
class Helpers {
public:
    void help(Calls& calls) {
        std::unique_lock lock(mutex_);
        waiting_.push_back(&calls);
        wanted_ += calls.wanted;
        try {
            for (; idle_ < wanted_; ++idle_) std::thread([this] { run(); }).detach();
        } catch (const std::system_error&) {  // there are no more to be had: fewer do the same
        }
        for (std::size_t k = 0; k < calls.wanted; ++k) more_.notify_one();
        lock.unlock();
        std::exception_ptr own;
        try {
            calls.make();
        } catch (...) {
            own = std::current_exception();
        }
        lock.lock();
        wanted_ -= calls.wanted;
        std::erase(waiting_, &calls);
        calls.wanted = 0;
        calls.left.wait(lock, [&] { return calls.inside == 0; });
        if (!own) own = calls.thrown;
        if (own) std::rethrow_exception(own);
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
            std::exception_ptr thrown;
            try {
                calls.make();
            } catch (...) {
                thrown = std::current_exception();
            }
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
    if (most < 2) return calls.make();
    calls.wanted = most - 1;
    helpers.help(calls);
}

}  // namespace natator
