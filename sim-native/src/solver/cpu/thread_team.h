#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <thread>
#include <vector>

namespace natator::cpu {

/// Threads that share loops. Whoever waits sleeps, so that a team costs other programs nothing.
class ThreadTeam {
public:
    /// A team of one runs all loops in the caller's thread.
    explicit ThreadTeam(int threads);
    ~ThreadTeam();
    ThreadTeam(const ThreadTeam&) = delete;
    ThreadTeam& operator=(const ThreadTeam&) = delete;

    int size() const { return static_cast<int>(helpers_.size()) + 1; }

    /// Calls work(part, begin, end) for each of the parts that [0, count) is cut into, side by side, and returns when
    /// all are done. No part is shorter than `grain` unless it is the only one, so short loops run as if alone. Throws
    /// what the first part in order threw.
    template <class Work>
    void for_parts(int count, int grain, const Work& work) {
        const int parts = std::max(1, std::min(size(), count / grain));
        if (parts == 1) return work(0, 0, count);
        run(parts, [&](int part) { work(part, cut(count, part, parts), cut(count, part + 1, parts)); });
    }

private:
    static int cut(int count, int part, int parts) {
        return static_cast<int>(static_cast<long long>(count) * part / parts);
    }
    void run(int parts, const std::function<void(int)>& work);
    void help(int part);
    void work_on(int part);

    std::vector<std::thread> helpers_;  ///< helper k does part k + 1
    std::vector<std::exception_ptr> thrown_;
    const std::function<void(int)>* work_ = nullptr;  ///< null: no more work will come
    int parts_ = 0;
    std::atomic<unsigned> call_{0};  ///< counts the calls of run
    std::atomic<int> busy_{0};       ///< helpers that have not ended the present one
};

}  // namespace natator::cpu
