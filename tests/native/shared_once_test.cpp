// Values that several threads need, such as settled starts.
#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <stdexcept>
#include <string>
#include <vector>

#include "run/cuda/shared_once.h"

namespace natator::cuda {
namespace {

using Words = SharedOnce<int, std::string>;

TEST(SharedOnce, IsAcquiredByTheFirst) {
    Words words({1, 1, 2, 3});
    EXPECT_EQ(words.acquire({2, 1, 1}), (std::vector{2, 1}));
    EXPECT_EQ(words.acquire({1, 3}), std::vector{3});
    EXPECT_EQ(words.acquire({1, 2, 3}), std::vector<int>{});
}

TEST(SharedOnce, ComesToAllThatWait) {
    std::vector<int> needs;
    for (int k = 0; k < 8; ++k) needs.insert(needs.end(), {1, 2});
    Words words(needs);
    std::atomic<int> made = 0;
    std::vector<std::future<std::string>> all;
    for (int k = 0; k < 8; ++k)
        all.push_back(std::async(std::launch::async, [&words, &made] {
            for (const int key : words.acquire({1, 2})) {
                ++made;
                words.publish(key, std::to_string(key));
            }
            const std::string both = *words.get(1) + *words.get(2);
            words.release({1, 2});
            return both;
        }));
    for (auto& one : all) EXPECT_EQ(one.get(), "12");
    EXPECT_EQ(made, 2);
}

TEST(SharedOnce, FailsWhereTheOneThatAcquiredItDoes) {
    Words words({1, 1, 2});
    const std::vector<int> acquired = words.acquire({1, 2});
    auto other = std::async(std::launch::async, [&words] { return *words.get(1); });
    words.publish(2, "two");
    words.fail(acquired, std::make_exception_ptr(std::runtime_error("no memory")));
    EXPECT_THROW(other.get(), std::runtime_error);
    EXPECT_EQ(*words.get(2), "two");
}

TEST(SharedOnce, IsForgottenWithTheLastNeed) {
    Words words({1, 1});
    words.acquire({1});
    words.publish(1, "one");
    const auto held = words.get(1);
    words.release({1});
    EXPECT_EQ(held.use_count(), 2);
    words.release({1});
    EXPECT_EQ(held.use_count(), 1);
    EXPECT_THROW(words.get(1), std::out_of_range);
}

}  // namespace
}  // namespace natator::cuda
