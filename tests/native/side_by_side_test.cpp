// Calls that several threads share, and whose turn it is.
#include "base/side_by_side.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "solver/cuda/grid/turns.h"

namespace natator {
namespace {

constexpr std::size_t per_processor = 8;  // so that there are several threads on any machine

/// Counts who is inside at a time.
struct Inside {
    std::atomic<int> now = 0, most = 0;

    void enter() {
        const int own = ++now;
        for (int seen = most; seen < own && !most.compare_exchange_weak(seen, own);) {
        }
        std::this_thread::sleep_for(std::chrono::microseconds(50));
        --now;
    }
};

TEST(SideBySide, MakesEachCallOnce) {
    for (const std::size_t count : {0, 1, 2, 7, 1000}) {
        std::vector<std::atomic<int>> calls(count);
        side_by_side(count, [&](std::size_t k) { ++calls[k]; }, SIZE_MAX, per_processor);
        EXPECT_TRUE(std::ranges::all_of(calls, [](int made) { return made == 1; })) << count;
    }
}

TEST(SideBySide, UsesNoMoreThreadsThanAsked) {
    Inside three, alone;
    side_by_side(100, [&](std::size_t) { three.enter(); }, 3, per_processor);
    EXPECT_LE(three.most, 3);
    side_by_side(10, [&](std::size_t) { alone.enter(); }, 1, per_processor);
    EXPECT_EQ(alone.most, 1);
}

TEST(SideBySide, CallsMayHaveCallsOfTheirOwn) {
    std::atomic<int> made = 0;
    const auto two = [&](std::size_t) { side_by_side(10, [&](std::size_t) { ++made; }, SIZE_MAX, per_processor); };
    const auto one = [&](std::size_t) { side_by_side(10, two, SIZE_MAX, per_processor); };
    for (int again = 0; again < 10; ++again) side_by_side(10, one, SIZE_MAX, per_processor);
    EXPECT_EQ(made, 10 * 1000);
}

TEST(SideBySide, CallsThatWaitForEachOtherHaveThreads) {
    constexpr std::size_t count = 6;
    std::atomic<std::size_t> arrived = 0;
    side_by_side(
        count,
        [&](std::size_t) {
            ++arrived;
            for (std::size_t seen = arrived; seen < count; seen = arrived) std::this_thread::yield();
        },
        count, per_processor);
    EXPECT_EQ(arrived, count);
}

TEST(SideBySide, ThrowsWhatACallThrewAfterAllHaveEnded) {
    for (int again = 0; again < 100; ++again) {
        std::atomic<int> inside = 0, made = 0;
        const auto work = [&](std::size_t k) {
            ++inside;
            ++made;
            --inside;
            if (k == 3) throw std::runtime_error("the fourth");
        };
        EXPECT_THROW(side_by_side(100, work, SIZE_MAX, per_processor), std::runtime_error);
        EXPECT_EQ(inside, 0);
        EXPECT_GE(made, 4);
    }
}

TEST(Turns, LetInSoManyAtATime) {
    cuda::Turns turns(2);
    std::atomic<int> came = 0;
    Inside inside;
    side_by_side(
        60,
        [&](std::size_t) {
            const cuda::Turns::Turn one(&turns);
            ++came;
            while (came < 2) std::this_thread::yield();  // the first waits for the second, who may come in
            inside.enter();
        },
        6, per_processor);
    EXPECT_LE(inside.most, 2);
}

}  // namespace
}  // namespace natator
