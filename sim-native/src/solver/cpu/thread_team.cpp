#include "thread_team.h"

#include <utility>

namespace natator::cpu {

ThreadTeam::ThreadTeam(int threads) : thrown_(std::max(threads, 1)) {
    for (int part = 1; part < threads; ++part) helpers_.emplace_back([this, part] { help(part); });
}

ThreadTeam::~ThreadTeam() {
    work_ = nullptr;
    ++call_;
    call_.notify_all();
    for (std::thread& helper : helpers_) helper.join();
}

void ThreadTeam::work_on(int part) {
    try {
        (*work_)(part);
    } catch (...) {
        thrown_[part] = std::current_exception();
    }
}

void ThreadTeam::help(int part) {
    for (unsigned seen = 0;; ++seen) {
        call_.wait(seen);
        if (!work_) return;
        if (part < parts_) work_on(part);
        if (--busy_ == 0) busy_.notify_one();
    }
}

void ThreadTeam::run(int parts, const std::function<void(int)>& work) {
    work_ = &work;
    parts_ = parts;
    busy_ = size() - 1;
    ++call_;
    call_.notify_all();
    work_on(0);
    for (int busy = busy_; busy != 0; busy = busy_) busy_.wait(busy);
    for (std::exception_ptr& thrown : thrown_)
        if (thrown) std::rethrow_exception(std::exchange(thrown, nullptr));
}

}  // namespace natator::cpu
