#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <thread>
#include <vector>

namespace natator::cpu {

/// Threads that share loops. Whoever waits for long sleeps, so that a team costs other programs nothing, and a loop
/// waits for no helper that has not begun, so that other programs cost a team little.
class ThreadTeam {
public:
    /// A team of one runs all loops in the caller's thread. It is smaller where the machine does not give so many
    /// threads.
    explicit ThreadTeam(int threads);
    ~ThreadTeam();
    ThreadTeam(const ThreadTeam&) = delete;
    ThreadTeam& operator=(const ThreadTeam&) = delete;

    int size() const { return static_cast<int>(helpers_.size()) + 1; }

    /// The most parts that a loop is cut into: several for each thread, so that one that is held up can leave some.
    int max_parts() const { return size() == 1 ? 1 : 4 * size(); }

    /// Calls work(part, begin, end) for each of the parts that [0, count) is cut into, side by side, and returns when
    /// all are done. The cuts depend on count, grain and size() alone. No part is shorter than `grain` unless it is the
    /// only one, so short loops run as if alone. Throws what the first part in order threw.
    template <class Work>
    void for_parts(int count, int grain, const Work& work) {
        int parts = std::max(1, std::min(max_parts(), count / grain));
        if (parts > size()) parts -= parts % size();  // as many for each thread
        if (parts == 1) return work(0, 0, count);
        run(parts, [&](int part) { work(part, cut(count, part, parts), cut(count, part + 1, parts)); });
    }

    /// Calls work(k) for each k of [0, count), in parts like those.
    template <class Work>
    void for_each(int count, int grain, const Work& work) {
        for_parts(count, grain, [&](int, int begin, int end) {
            for (int k = begin; k < end; ++k) work(k);
        });
    }

private:
    static int cut(int count, int part, int parts) {
        return static_cast<int>(static_cast<long long>(count) * part / parts);
    }
    void run(int parts, const std::function<void(int)>& work);
    void help(int number);
    bool enter();
    void take_parts(int number);

    std::vector<std::thread> helpers_;
    const std::function<void(int)>* work_ = nullptr;
    std::vector<std::exception_ptr> thrown_;  ///< by part
    std::atomic<bool> over_{false};           ///< no more work will come
    std::atomic<unsigned> call_{0};           ///< counts the calls of run
    /// Parts of one thread that nobody has taken: it begins with those, so that it finds in its cache what it left
    /// there.
    struct alignas(64) Share {
        std::atomic<int> next{0};
        int end = 0;
    };
    std::vector<Share> shares_;  ///< by thread
    std::atomic<int> inside_;    ///< helpers in the present call; -1: none may enter
};

}  // namespace natator::cpu
