// What is made of the forces on a body that is towed.
#include "water/towing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace natator::bench {
namespace {

/// The box's steps knock the body harder than vortices swing it, and more often; something else swings nearly as often
/// as these, and noise passes the mean, too.
TEST(Towing, TheFrequencyOfTheLiftIsThatOfItsSwings) {
    constexpr double speed = 1.5, frame = 1.0 / 60, swings = 0.26, turn = 2 * std::numbers::pi;
    TowResult result;
    result.box_step = 1.05;
    result.legs.emplace_back();
    for (double time = frame; time * speed < 60; time += frame) {
        const double way = time * speed, since_step = std::fmod(way, result.box_step);
        const double knock = since_step < 0.3 ? 2 : since_step < 0.5 ? -1.5 : 0;
        const double other = 1.3 * std::sin(turn * 1.12 * time), noise = 0.5 * std::sin(1e4 * time);
        const double lift = 0.1 + 0.3 * std::sin(turn * swings * time);
        result.legs[0].push_back({time, way, 1.4, lift + knock + other + noise});
    }
    EXPECT_NEAR(lift_frequency(result, 30), swings, 0.02 * swings);
    for (TowSample& sample : result.legs[0]) sample.lift = 0;
    EXPECT_EQ(lift_frequency(result, 30), 0);
}

}  // namespace
}  // namespace natator::bench
