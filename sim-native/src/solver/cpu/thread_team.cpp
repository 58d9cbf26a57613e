#include "thread_team.h"

#include <utility>

namespace natator::cpu {

ThreadTeam::ThreadTeam(int threads) {
    for (int k = 1; k < threads; ++k) helpers_.emplace_back([this] { help(); });
}

ThreadTeam::~ThreadTeam() {
    work_ = nullptr;
    ++call_;
    call_.notify_all();
    for (std::thread& helper : helpers_) helper.join();
}

void ThreadTeam::take_parts() {
    const int parts = static_cast<int>(thrown_.size());
    for (int part = next_++; part < parts; part = next_++) {
        try {
            (*work_)(part);
        } catch (...) {
            thrown_[part] = std::current_exception();
        }
    }
}

void ThreadTeam::help() {
    for (unsigned seen = 0;; ++seen) {
        call_.wait(seen);
        if (!work_) return;
        take_parts();
        if (--busy_ == 0) busy_.notify_one();
    }
}

void ThreadTeam::run(int parts, const std::function<void(int)>& work) {
    work_ = &work;
    thrown_.assign(parts, nullptr);
    next_ = 0;
    busy_ = size() - 1;
    ++call_;
    call_.notify_all();
    take_parts();
    for (int busy = busy_; busy != 0; busy = busy_) busy_.wait(busy);
    for (const std::exception_ptr& thrown : thrown_)
        if (thrown) std::rethrow_exception(thrown);
}

}  // namespace natator::cpu
