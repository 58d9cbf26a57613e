// The body that swims in the case travelling-wave: how it bends, and how it moves by the forces on it.
#include <gtest/gtest.h>

#include <cmath>

#include "water/free_motion.h"
#include "water/larva.h"

namespace natator::bench {
namespace {

using Places = std::vector<Eigen::Vector3d>;

const Larva larva(2, 0.5, 0.05);

/// Of the straight body.
Places midline() {
    Places places;
    for (int k = 0; k <= 100; ++k) places.emplace_back(-larva.length() * k / 100, 0, 0);
    return places;
}

Places body() {
    Places places;
    for (double x = -larva.length(); x <= 0; x += 0.1)
        for (double y = -0.2; y <= 0.2; y += 0.1)
            for (double z = -0.2; z <= 0.2; z += 0.1)
                if (larva.holds({x, y, z})) places.emplace_back(x, y, z);
    return places;
}

TEST(Larva, IsSlenderAndNarrowsToItsTail) {
    const auto half_width = [](double x) {
        double z = 0;
        while (larva.holds({x, 0, z + 0.001})) z += 0.001;
        return z;
    };
    EXPECT_NEAR(half_width(-0.3), 0.13, 0.01);
    EXPECT_NEAR(half_width(-1.99), 0.06, 0.01);
    EXPECT_FALSE(larva.holds({0.01, 0, 0}));
    EXPECT_FALSE(larva.holds({-2.01, 0, 0}));
    EXPECT_FALSE(larva.holds({-1, 0.16, 0}));
}

/// The midline keeps its length, the body's sections their shape and the head is stiff; the tail beats half a length from
/// side to side, and the wave goes towards it.
TEST(Larva, BendsByAWaveTowardsItsTail) {
    const double late = 3 * larva.beat();
    for (const double time : {0.0, 0.4 * larva.beat(), late, late + 0.3}) {
        const Places line = larva.bent(midline(), time);
        for (std::size_t k = 1; k < line.size(); ++k)
            ASSERT_NEAR((line[k] - line[k - 1]).norm(), larva.length() / 100, 1e-3 * larva.length() / 100) << time;
        for (std::size_t k = 0; k <= 20; ++k) EXPECT_LE((line[k] - midline()[k]).norm(), 1e-12) << time;
        const Places section = larva.bent({{-1.5, 0.1, -0.05}, {-1.5, -0.1, 0.05}}, time);
        EXPECT_NEAR((section[1] - section[0]).norm(), std::hypot(0.2, 0.1), 1e-12);
    }
    // Where it bends most to one side: the wave is there so much later.
    const auto bending_at = [](std::size_t k, double time) {
        const Places line = larva.bent(midline(), time);
        return (line[k - 1] - line[k]).cross(line[k] - line[k + 1]).y();
    };
    const double later = 0.4 / 1.2 * larva.beat();  // from 0.4 to 0.8 of the length
    for (const double time : {late, late + 0.5, late + 1.1}) {
        const double early = bending_at(40, time), follows = bending_at(80, time + later);
        EXPECT_GT(std::abs(early), 5e-6);
        EXPECT_GT(follows / early, 1) << time;
        EXPECT_LT(follows / early, 1.5) << time;
    }
}

/// Without forces it bends but neither goes nor turns, whatever its shape's own frame does.
TEST(FreeMotion, BendingAloneHasNoMomentum) {
    const Places straight = body();
    FreeMotion motion(straight);
    const Eigen::Vector3d start = motion.centre();
    constexpr double h = 0.005;
    double most = 0, size = 0;
    for (int k = 1; k <= 800; ++k) {
        const Places before = motion.places();
        const Places velocities = motion.set_off(larva.bent(straight, k * h), h);
        Eigen::Vector3d momentum = Eigen::Vector3d::Zero(), spin = momentum;
        double all = 0;
        for (std::size_t i = 0; i < before.size(); ++i) {
            momentum += velocities[i];
            spin += (before[i] - motion.centre()).cross(velocities[i]);
            all += (before[i] - motion.centre()).cross(velocities[i]).norm();
        }
        EXPECT_LE(momentum.norm(), 1e-9 * static_cast<double>(before.size()));
        most = std::max(most, spin.norm());
        size = std::max(size, all);
        motion.arrive(Places(before.size(), Eigen::Vector3d::Zero()), h);
    }
    EXPECT_GT(size, 10);
    EXPECT_LE(most, 0.02 * size);
    EXPECT_LE((motion.centre() - start).norm(), 1e-9);
}

/// F = m a and M = I alpha of a stiff body; what lifts or tilts it does nothing.
TEST(FreeMotion, ForcesMoveAndTurnIt) {
    Places bar;
    for (int k = 0; k <= 20; ++k) bar.emplace_back(0.1 * k - 1, 0, 0);
    FreeMotion motion(bar);
    constexpr double h = 0.001, time = 1;
    for (int k = 0; k < time / h; ++k) {
        motion.set_off(bar, h);
        Places forces;
        for (const auto& x : motion.places()) {
            const Eigen::Vector3d arm = x - motion.centre();
            forces.push_back(Eigen::Vector3d(0.3, 5, 0) + 0.2 * Eigen::Vector3d::UnitY().cross(arm));
        }
        motion.arrive(forces, h);
    }
    EXPECT_NEAR(motion.velocity().x(), 0.3 * time, 1e-3);
    EXPECT_EQ(motion.velocity().y(), 0);
    EXPECT_NEAR(motion.centre().x(), 0.15 * time * time, 1e-3);
    const Eigen::Vector3d end = motion.places().back() - motion.centre();
    EXPECT_NEAR(std::atan2(-end.z(), end.x()), 0.1 * time * time, 1e-3);
    EXPECT_NEAR(end.norm(), 1, 1e-9);
}

/// Whatever momentum it has.
TEST(FreeMotion, ItIsSteered) {
    const Places bar{{-1, 0, 0}, {1, 0, 0}};
    FreeMotion motion(bar);
    motion.steer(0.2);
    for (int k = 0; k < 100; ++k) {
        motion.set_off(bar, 0.01);
        motion.arrive(Places(2, Eigen::Vector3d::Zero()), 0.01);
    }
    EXPECT_NEAR(motion.angle(), 0.2, 1e-12);
    EXPECT_LE((motion.places()[1] - Eigen::Vector3d(std::cos(0.2), 0, -std::sin(0.2))).norm(), 1e-12);
}

/// Water that goes along with four times the body's mass, and shows it a step late.
TEST(FreeMotion, BearsAddedMassOfWater) {
    FreeMotion motion({{-1, 0, 0}, {1, 0, 0}});
    constexpr double h = 0.01, added = 4, push = 0.7;
    double before = 0;
    for (int k = 0; k < 400; ++k) {
        motion.set_off({{-1, 0, 0}, {1, 0, 0}}, h);
        const double acceleration = (motion.velocity().x() - before) / h;
        before = motion.velocity().x();
        motion.arrive(Places(2, Eigen::Vector3d(push - added * acceleration, 0, 0)), h);
    }
    EXPECT_NEAR(motion.velocity().x(), push / (1 + added) * 400 * h, 0.02);
}

TEST(Larvae, HaveTheStrouhalNumbersOfTheirReynoldsNumbers) {
    EXPECT_NEAR(strouhal_of_larvae(60), 2.5, 1e-12);
    EXPECT_NEAR(strouhal_of_larvae(1400), 0.72, 1e-12);
    for (const double reynolds : {60.0, 300.0, 1400.0})
        EXPECT_NEAR(reynolds_of_larvae(reynolds * strouhal_of_larvae(reynolds)), reynolds, 1e-9 * reynolds);
}

}  // namespace
}  // namespace natator::bench
