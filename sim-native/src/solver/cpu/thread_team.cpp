#include "thread_team.h"

#include <system_error>
#include <utility>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace natator::cpu {
namespace {

constexpr int closed = -1;

void pause() {
#if defined(__SSE2__)
    _mm_pause();
#endif
}

/// Returns once value is no longer `old`. Mostly that is after the rest of a loop, or the little that one thread does
/// between two; falling asleep and being woken takes longer than these, so it looks for a while before it sleeps.
template <class T>
void wait(const std::atomic<T>& value, T old) {
    constexpr int looks = 4000;  // some forty microseconds
    for (int k = 0; k < looks; ++k) {
        if (value != old) return;
        pause();
    }
    value.wait(old);
}

}  // namespace

ThreadTeam::ThreadTeam(int threads) : shares_(std::max(1, threads)), inside_(closed) {
    helpers_.reserve(shares_.size() - 1);
    try {
        for (int k = 1; k < threads; ++k) helpers_.emplace_back([this, k] { help(k); });
    } catch (const std::system_error&) {  // there are no more to be had: fewer do the same
    }
}

ThreadTeam::~ThreadTeam() {
    over_ = true;
    ++call_;
    call_.notify_all();
    for (std::thread& helper : helpers_) helper.join();
}

void ThreadTeam::take_parts(int number) {
    for (int k = 0; k < size(); ++k) {
        Share& share = shares_[(number + k) % size()];
        for (int part = share.next++; part < share.end; part = share.next++) {
            try {
                (*work_)(part);
            } catch (...) {
                thrown_[part] = std::current_exception();
            }
        }
    }
}

bool ThreadTeam::enter() {
    int inside = inside_;
    while (inside != closed)
        if (inside_.compare_exchange_weak(inside, inside + 1)) return true;
    return false;
}

void ThreadTeam::help(int number) {
    for (unsigned seen = 0;;) {
        wait(call_, seen);
        seen = call_;
        if (over_) return;
        if (!enter()) continue;
        take_parts(number);
        if (--inside_ == 0) inside_.notify_one();
    }
}

void ThreadTeam::run(int parts, const std::function<void(int)>& work) {
    work_ = &work;
    thrown_.assign(parts, nullptr);
    for (int k = 0; k < size(); ++k) {
        shares_[k].next = cut(parts, k, size());
        shares_[k].end = cut(parts, k + 1, size());
    }
    inside_ = 0;
    ++call_;
    call_.notify_all();
    take_parts(0);
    for (int inside = 0; !inside_.compare_exchange_strong(inside, closed); inside = 0) wait(inside_, inside);
    for (const std::exception_ptr& thrown : thrown_)
        if (thrown) std::rethrow_exception(thrown);
}

}  // namespace natator::cpu
