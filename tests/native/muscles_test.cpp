// The muscle rules of thesis 2.4 (figures 2.5 to 2.8) for joints of equal and unequal slices.
#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "natator/error.h"
#include "natator/model.h"

namespace natator {
namespace {

/// A muscle's ends in its two slices, each counted from the lower left: front y, front z, rear y, rear z.
using Ends = std::tuple<int, int, int, int>;
using SpringCounts = std::map<Ends, int>;

/// A body with `between` slices between two joints, and one slice before and behind them.
Scene body(Slice front, std::vector<Slice> between, Slice rear) {
    Scene scene;
    Creature creature;
    creature.slices = {front, front};
    creature.slices.insert(creature.slices.end(), between.begin(), between.end());
    creature.slices.insert(creature.slices.end(), {rear, rear});
    creature.joints = {1, static_cast<int>(creature.slices.size()) - 2};
    scene.creature = creature;
    return scene;
}

/// Springs per pair of places, between joint slices 1 and the last but one.
SpringCounts springs(const Scene& scene) {
    const Model model = build_model(scene);
    const auto place = [&](int particle) {
        for (std::size_t slice = 0; slice < model.body.slices.size(); ++slice) {
            const auto& members = model.body.slices[slice];
            const auto found = std::find(members.begin(), members.end(), particle);
            if (found == members.end()) continue;
            const int index = static_cast<int>(found - members.begin());
            const int width = scene.creature->slices[slice].width;
            return std::pair(index / width, index % width);
        }
        return std::pair(-1, -1);
    };
    SpringCounts counts;
    for (const Spring& spring : model.springs) {
        const auto [fy, fz] = place(spring.a);
        const auto [ry, rz] = place(spring.b);
        ++counts[{fy, fz, ry, rz}];
    }
    return counts;
}

SpringCounts straight(int height, std::vector<int> columns, int count) {
    SpringCounts counts;
    for (int y = 0; y < height; ++y) {
        for (const int z : columns) counts[{y, z, y, z}] = count;
    }
    return counts;
}

TEST(MusclesTest, EvenSlicesOfOneSizeAreJoinedStraightWithFourSpringsEach) {
    EXPECT_EQ(springs(body({2, 4}, {{2, 4}}, {2, 4})), straight(2, {0, 1, 2, 3}, 4));
}

TEST(MusclesTest, OddSlicesOfOneSizeLeaveTheLateralMiddleOut) {
    EXPECT_EQ(springs(body({3, 3}, {{3, 3}}, {3, 3})), straight(3, {0, 2}, 4));
}

TEST(MusclesTest, NeighbouringJointsWithoutASliceBetweenAreJoinedToo) {
    EXPECT_EQ(springs(body({1, 2}, {}, {1, 2})), straight(1, {0, 1}, 4));
}

/// Widths 4 and 2: both even, so straight lines; the outer columns of the wide slice have no partner.
TEST(MusclesTest, AnEvenDifferenceInWidthJoinsTheInnerColumnsStraight) {
    const SpringCounts expected = {{{0, 1, 0, 0}, 4}, {{0, 2, 0, 1}, 4}, {{1, 1, 1, 0}, 4}, {{1, 2, 1, 1}, 4}};
    EXPECT_EQ(springs(body({2, 4}, {{2, 4}}, {2, 2})), expected);
}

/// Widths 4 and 3: the rear one gives, each of its outer columns to the two columns half a spacing beside it.
TEST(MusclesTest, AnOddDifferenceInWidthSharesFourSpringsBetweenTwoPartners) {
    const SpringCounts expected = {{{0, 0, 0, 0}, 2}, {{0, 1, 0, 0}, 2}, {{0, 2, 0, 2}, 2}, {{0, 3, 0, 2}, 2}};
    EXPECT_EQ(springs(body({1, 4}, {{1, 4}}, {1, 3})), expected);
}

/// Widths 3 and 2: the middle column would be a partner but lies on neither side, so one partner takes all four.
TEST(MusclesTest, TheMiddleIsNoPartnerAcrossAnOddDifferenceInWidth) {
    const SpringCounts expected = {{{0, 0, 0, 0}, 4}, {{0, 2, 0, 1}, 4}};
    EXPECT_EQ(springs(body({1, 3}, {{1, 3}}, {1, 2})), expected);
}

/// Heights 2 and 3: the front gives; each particle has a partner half a spacing above and one below.
TEST(MusclesTest, AnOddDifferenceInHeightSharesFourSpringsBetweenTwoPartners) {
    const SpringCounts expected = {{{0, 0, 0, 0}, 2}, {{0, 0, 1, 0}, 2}, {{0, 1, 0, 1}, 2}, {{0, 1, 1, 1}, 2},
                                   {{1, 0, 1, 0}, 2}, {{1, 0, 2, 0}, 2}, {{1, 1, 1, 1}, 2}, {{1, 1, 2, 1}, 2}};
    EXPECT_EQ(springs(body({2, 2}, {{3, 2}}, {3, 2})), expected);
}

/// Height 2, width 4 against height 1, width 3: four partners, one spring each.
TEST(MusclesTest, AnOddDifferenceInBothGivesFourPartnersOneSpringEach) {
    const SpringCounts expected = {{{0, 0, 0, 0}, 1}, {{0, 1, 0, 0}, 1}, {{0, 2, 0, 2}, 1}, {{0, 3, 0, 2}, 1},
                                   {{1, 0, 0, 0}, 1}, {{1, 1, 0, 0}, 1}, {{1, 2, 0, 2}, 1}, {{1, 3, 0, 2}, 1}};
    EXPECT_EQ(springs(body({2, 4}, {{2, 4}}, {1, 3})), expected);
}

/// What does not divide goes to the partner nearest the axis: here the inner columns of the wide slice.
TEST(MusclesTest, TheRemainderGoesToThePartnersNearestTheAxis) {
    Scene scene = body({1, 4}, {{1, 4}}, {1, 3});
    scene.creature->springs_per_particle = 3;
    const SpringCounts expected = {{{0, 0, 0, 0}, 1}, {{0, 1, 0, 0}, 2}, {{0, 2, 0, 2}, 2}, {{0, 3, 0, 2}, 1}};
    EXPECT_EQ(springs(scene), expected);
    scene.creature->springs_per_particle = 1;
    const SpringCounts inner = {{{0, 1, 0, 0}, 1}, {{0, 2, 0, 2}, 1}};
    EXPECT_EQ(springs(scene), inner);
}

/// Slices of equal size but different shape: the front one gives. 4 high x 3 wide against 3 high x 4 wide.
TEST(MusclesTest, OfSlicesWithEquallyManyParticlesTheFrontOneGives) {
    const SpringCounts counts = springs(body({4, 3}, {{4, 4}}, {3, 4}));
    std::map<std::pair<int, int>, int> given;
    for (const auto& [ends, count] : counts) given[{std::get<0>(ends), std::get<1>(ends)}] += count;
    ASSERT_EQ(given.size(), 8u);  // 4 rows, columns 0 and 2
    for (const auto& [place, count] : given) EXPECT_EQ(count, 4) << place.first << ' ' << place.second;
}

/// A slice of width 2 between joints of width 4 stops the outer muscles; so does one of height 2 those above it.
TEST(MusclesTest, AThinSliceBetweenStopsTheMusclesOutsideIt) {
    EXPECT_EQ(springs(body({1, 4}, {{1, 4}, {1, 2}, {1, 4}}, {1, 4})), straight(1, {1, 2}, 4));
    const SpringCounts expected = {{{1, 0, 1, 0}, 4}, {{1, 1, 1, 1}, 4}, {{2, 0, 2, 0}, 4}, {{2, 1, 2, 1}, 4}};
    EXPECT_EQ(springs(body({4, 2}, {{2, 2}}, {4, 2})), expected);
}

/// A slanted muscle is measured where it crosses the slice. From width 4 to width 3 (columns at 1.5 and 1 spacings
/// from the axis) it is at 1.25 half-way: inside a slice of width 3, outside one of width 2.
TEST(MusclesTest, ASlantedMuscleIsMeasuredWhereItCrossesTheSlice) {
    EXPECT_EQ(springs(body({1, 4}, {{1, 3}}, {1, 3})).count({0, 0, 0, 0}), 1u);
    const SpringCounts through_two = springs(body({1, 4}, {{1, 2}}, {1, 3}));
    const SpringCounts expected = {{{0, 1, 0, 0}, 4}, {{0, 2, 0, 2}, 4}};  // at 0.75 < 1
    EXPECT_EQ(through_two, expected);
}

TEST(MusclesTest, AnActuatorWithoutMusclesIsRefused) {
    EXPECT_THROW(build_model(body({3, 1}, {{3, 3}}, {3, 3})), InputError);
    EXPECT_THROW(build_model(body({3, 3}, {{3, 1}}, {3, 3})), InputError);
}

/// z_m is the mean of both ends' lateral places: -1 and +1 at the edges of a slice of any width.
TEST(MusclesTest, LateralPlaceIsTheMeanOfBothEnds) {
    const Scene scene = body({1, 4}, {{1, 4}}, {1, 3});
    const Model model = build_model(scene);
    std::vector<double> lateral;
    for (const Muscle& muscle : model.muscles) lateral.push_back(muscle.lateral);
    // Front columns at -1, -1/3, 1/3, 1; rear ones at -1 and 1.
    const std::vector<double> expected = {-1, -1, -2.0 / 3, -2.0 / 3, 2.0 / 3, 2.0 / 3, 1, 1};
    ASSERT_EQ(lateral.size(), expected.size());
    for (std::size_t i = 0; i < lateral.size(); ++i) EXPECT_NEAR(lateral[i], expected[i], 1e-15) << i;
}

/// Two spacings along the body, half a spacing sideways.
TEST(MusclesTest, RestLengthIsTheDistanceAtRest) {
    Scene scene = body({1, 4}, {{1, 4}}, {1, 3});
    scene.creature->spacing = 0.1;
    for (const Spring& spring : build_model(scene).springs) {
        EXPECT_NEAR(spring.rest_length, 0.206155281280883, 1e-12);  // sqrt(0.2^2 + 0.05^2)
        EXPECT_EQ(spring.stiffness, 1);
    }
}

TEST(MusclesTest, SpringsAreSortedByActuatorFrontAndRearParticle) {
    Scene scene;
    scene.creature.emplace();
    scene.creature->slices.assign(9, Slice{3, 4});
    scene.creature->joints = {1, 4, 7};
    const Model model = build_model(scene);
    EXPECT_EQ(model.actuators, 2);
    ASSERT_EQ(model.muscles.size(), model.springs.size());
    std::tuple<int, int, int> last{-1, -1, -1};
    for (std::size_t i = 0; i < model.muscles.size(); ++i) {
        EXPECT_EQ(model.muscles[i].spring, static_cast<int>(i));
        const std::tuple key(model.muscles[i].actuator, model.springs[i].a, model.springs[i].b);
        EXPECT_LE(last, key);
        last = key;
    }
    EXPECT_EQ(model.springs.size(), 2u * 12 * 4);
}

/// Slices of 90 000 particles, 300 times the largest of the thesis: each finds its partners without looking at all.
TEST(MusclesTest, LargeSlicesAreJoinedByTheSameRules) {
    const Model model = build_model(body({300, 300}, {}, {301, 299}));
    // The rear slice has fewer particles, so it gives, but for its middle column: 4 springs to 4 partners, as the sizes
    // differ by an odd number, and twice 2 in the outermost rows, which the front slice does not reach.
    EXPECT_EQ(model.springs.size(), 301u * 298 * 4);
    std::map<std::pair<int, int>, int> coincident;
    for (const Spring& spring : model.springs) ++coincident[{spring.a, spring.b}];
    const auto wide =
        std::count_if(coincident.begin(), coincident.end(), [](const auto& pair) { return pair.second > 1; });
    EXPECT_GT(wide, 0);
    EXPECT_LT(static_cast<std::size_t>(wide), coincident.size());
}

}  // namespace
}  // namespace natator
