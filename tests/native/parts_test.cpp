// Members of a batch on a GPU that are computed in parts, by streams side by side.
#include "solver/cuda/grid/parts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace natator::cuda {
namespace {

TEST(Parts, HoldEachMemberOnce) {
    for (int members = 1; members <= 40; ++members)
        for (int most = 1; most <= 12; ++most)
            for (int streams = 1; streams <= 3; ++streams) {
                const Parts parts(members, most, streams);
                std::vector<int> held(members, 0);
                for (int part = 0; part < parts.count; ++part) {
                    EXPECT_LE(parts.size_of(part), most);
                    EXPECT_GE(parts.size_of(part), 1) << members << ' ' << most;
                    for (int k = 0; k < parts.size_of(part); ++k) ++held.at(parts.first(part) + k);
                }
                EXPECT_EQ(held, std::vector<int>(members, 1)) << members << ' ' << most;
                EXPECT_LE(parts.streams, parts.count);
            }
}

TEST(Parts, AreOfNearlyOneSize) {
    const Parts parts(150, 70, 2);
    EXPECT_EQ(parts.count, 4) << "as many for each stream: of three parts one stream would have two";
    EXPECT_EQ(parts.size(), 38);
    EXPECT_EQ(parts.size_of(3), 37);
    EXPECT_EQ(parts.streams, 2);
}

TEST(Parts, KeepNoStreamWaiting) {
    for (int streams = 1; streams <= 3; ++streams)
        for (int most = 1; most <= 12; ++most)
            for (int members = streams; members <= 40; ++members) {
                const Parts parts(members, most, streams);
                std::vector<int> of_stream(streams, 0), parts_of(streams, 0);
                for (int part = 0; part < parts.count; ++part) {
                    of_stream[part % streams] += parts.size_of(part);
                    ++parts_of[part % streams];
                }
                const auto [fewest, largest] = std::ranges::minmax(of_stream);
                EXPECT_TRUE(parts.count == members || parts.count % streams == 0) << members << ' ' << most;
                EXPECT_LE(largest - fewest, parts_of.front()) << "at most one in each part: " << members << ' ' << most;
            }
}

TEST(Parts, EachStreamHasOne) {
    EXPECT_EQ(Parts(150, 1000, 2).size(), 75);
    EXPECT_EQ(Parts(3, 1000, 2).size(), 2);
    EXPECT_EQ(Parts(1, 1000, 2).count, 1);
    EXPECT_EQ(Parts(150, 33, 2).size(), 25) << "six parts, three for each stream";
}

}  // namespace
}  // namespace natator::cuda
