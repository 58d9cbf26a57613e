// Richardson estimates of figures whose limit is known.
#include <gtest/gtest.h>

#include <cmath>

#include "natator/error.h"
#include "run/converge/estimate.h"
#include "run/converge/level.h"

namespace natator {
namespace {

Sample exactly(double mean) {
    return {mean, 0, 8};
}

TEST(Convergence, SamplesHaveAMeanAndItsStandardError) {
    const Sample sample = sample_of({1, 2, 3, 4});
    EXPECT_DOUBLE_EQ(sample.mean, 2.5);
    EXPECT_NEAR(sample.error, std::sqrt(5.0 / 3 / 4), 1e-12);
    EXPECT_EQ(sample.runs, 4);
    EXPECT_TRUE(std::isinf(sample_of({7}).error)) << "one run does not tell how well it is known";
    EXPECT_EQ(sample_of({}).runs, 0);
}

TEST(Convergence, RelativeChangesHaveTheErrorOfBoth) {
    const auto change = relative_change({2, 0.1, 8}, {3, 0.2, 8});
    ASSERT_TRUE(change);
    EXPECT_DOUBLE_EQ(change->mean, 0.5);
    EXPECT_NEAR(change->error, std::hypot(0.2, 1.5 * 0.1) / 2, 1e-12);
    EXPECT_FALSE(relative_change(exactly(0), exactly(1)));
    EXPECT_TRUE(relative_change({0.21, 0.1, 8}, {3, 0.2, 8}));
    EXPECT_TRUE(relative_change({-0.21, 0.1, 8}, {3, 0.2, 8}));
    for (const double mean : {-0.2, 0.01, 0.19})
        EXPECT_FALSE(relative_change({mean, 0.1, 8}, {3, 0.2, 8})) << "what may be 0 is no measure: " << mean;
    EXPECT_TRUE(relative_change(sample_of({1}), {3, 0.2, 8})) << "one run does not tell";
    const Sample by = difference({0.01, 0.3, 8}, {0.05, 0.4, 8});
    EXPECT_NEAR(by.mean, 0.04, 1e-12);
    EXPECT_NEAR(by.error, 0.5, 1e-12);
}

/// f(h) = 5 + 3 h at 1 and 1/2.
TEST(Convergence, TwoLevelsAreTakenForFirstOrder) {
    const Limit limit = limit_of(exactly(8), exactly(6.5), std::nullopt);
    EXPECT_EQ(limit.order, 1);
    EXPECT_FALSE(limit.observed);
    EXPECT_DOUBLE_EQ(limit.from_base, -3);
    EXPECT_DOUBLE_EQ(limit.from_finest, -1.5);
}

/// f(h) = 5 + 3 h^2 at 1, 1/2, 1/4.
TEST(Convergence, ThreeLevelsShowTheOrder) {
    const Limit limit = limit_of({8, 0.01, 8}, {5.75, 0.01, 8}, Sample{5.1875, 0.01, 8});
    EXPECT_TRUE(limit.observed);
    EXPECT_NEAR(limit.order, 2, 1e-12);
    EXPECT_NEAR(limit.from_base, -3, 1e-12);
}

TEST(Convergence, ChangesWithinTheirErrorsShowNoOrder) {
    EXPECT_FALSE(limit_of({8, 0.5, 8}, {7.2, 0.5, 8}, Sample{6.9, 0.5, 8}).observed);
    const Limit back = limit_of(exactly(8), exactly(7), Sample{7.5, 0, 8});  // to and fro
    EXPECT_FALSE(back.observed);
    EXPECT_DOUBLE_EQ(back.from_finest, 0.5);
    EXPECT_DOUBLE_EQ(back.from_base, 0);
}

TEST(Convergence, TheEstimateGoesToBothLimits) {
    const Estimate estimate = estimate_of({8, 0.1, 8}, Sample{7.5, 0.2, 8}, std::nullopt, Sample{9, 0.3, 8});
    EXPECT_DOUBLE_EQ(estimate.value, 8 - 1 + 2);
    EXPECT_NEAR(estimate.discretisation, std::hypot(0.5, 1.0), 1e-12);
    EXPECT_NEAR(estimate.statistical, std::hypot(3 * 0.1, std::hypot(2 * 0.2, 2 * 0.3)), 1e-12);
    EXPECT_NEAR(estimate.error, std::hypot(estimate.statistical, estimate.discretisation), 1e-12);
    const Estimate one_run = estimate_of({8, 0.1, 8}, sample_of({7.5}), std::nullopt, std::nullopt);
    EXPECT_EQ(one_run.value, 7);
    EXPECT_TRUE(std::isinf(one_run.error));
    const Estimate alone = estimate_of({8, 0.1, 8}, std::nullopt, std::nullopt, std::nullopt);
    EXPECT_EQ(alone.value, 8);
    EXPECT_EQ(alone.error, 0.1);
}

/// In scheme lattice half the spacing comes with half the time step, whose part counts once.
TEST(Convergence, AStepHalvedWithTheSpacingCountsOnce) {
    const double v = 1, by_step = -0.5, by_spacing = 0.25;  // what goes with h and with the spacing to the first order
    const Sample base{v + by_step + by_spacing, 0.1, 8}, half{v + by_step / 2 + by_spacing, 0.2, 8},
        finer{v + (by_step + by_spacing) / 2, 0.3, 8};
    const Estimate estimate = estimate_of(base, half, std::nullopt, finer, true);
    EXPECT_NEAR(estimate.value, v, 1e-12);
    EXPECT_NEAR(estimate.statistical, std::hypot(0.1, 2 * 0.3), 1e-12);  // 2 finer - base
    EXPECT_NEAR(estimate_of(base, std::nullopt, std::nullopt, finer, true).value, v, 1e-12);
    EXPECT_NEAR(estimate_of(base, half, std::nullopt, finer).value, v - by_step, 1e-12);  // as if it had not come along
}

/// The weights of the errors are those of the values.
TEST(Convergence, ErrorsGoWithTheirWeights) {
    const auto value = [](double base, double half, double quarter) {
        return estimate_of({base, 1e-3, 8}, Sample{half, 1e-3, 8}, Sample{quarter, 1e-3, 8}, std::nullopt).value;
    };
    const Estimate at = estimate_of({8, 1e-3, 8}, Sample{7.6, 1e-3, 8}, Sample{7.7, 1e-3, 8}, std::nullopt);
    const double f = value(8, 7.6, 7.7), d = 1e-3;
    const double expected =
        std::hypot(value(8 + d, 7.6, 7.7) - f, value(8, 7.6 + d, 7.7) - f, value(8, 7.6, 7.7 + d) - f);
    EXPECT_NEAR(at.statistical, expected, 1e-9);
}

TEST(Convergence, LevelsHaveNames) {
    EXPECT_EQ(Level::named("both/2").time, 2);
    EXPECT_EQ(Level::named("both/2").space, 2);
    EXPECT_EQ(Level::named("time/4").time, 4);
    EXPECT_THROW(Level::named("time/3"), InputError);
}

}  // namespace
}  // namespace natator
