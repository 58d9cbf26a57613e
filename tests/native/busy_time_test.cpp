// How long streams side by side are busy: the time of a batch's kernels.
#include "run/cuda/busy_time.h"

#include <gtest/gtest.h>

namespace natator::cuda {
namespace {

Span span(int begin, int end) {
    const HostTime zero{};
    return {zero + std::chrono::seconds(begin), zero + std::chrono::seconds(end)};
}

TEST(BusyTime, CountsWhatOverlapsOnce) {
    EXPECT_EQ(busy_seconds({}), 0);
    EXPECT_EQ(busy_seconds({span(1, 3)}), 2);
    EXPECT_EQ(busy_seconds({span(1, 4), span(2, 3)}), 3) << "one within the other";
    EXPECT_EQ(busy_seconds({span(5, 7), span(1, 3)}), 4) << "one after the other, in any order";
    EXPECT_EQ(busy_seconds({span(1, 3), span(2, 5), span(5, 6), span(10, 11)}), 6);
}

}  // namespace
}  // namespace natator::cuda
