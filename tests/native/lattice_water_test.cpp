// Water on a lattice against closed forms and conservation laws.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "lattice_bar.h"
#include "natator/error.h"

namespace natator::lattice {
namespace {

constexpr double pi = std::numbers::pi;

Eigen::Vector3d momentum(const Water& water) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for_each_cell(water.box(), [&](const Eigen::Vector3i& at) {
        const Cell cell = water.cell(at);
        sum += (1 + cell.excess) * cell.velocity;
    });
    return sum;
}

void advance(Water& water, int steps) {
    std::vector<Push> pushes;
    for (int k = 0; k < steps; ++k) water.advance({}, 1, pushes);
}

double largest_difference(const std::vector<double>& some, const std::vector<double>& others) {
    double most = 0;
    for (std::size_t i = 0; i < some.size(); ++i) most = std::max(most, std::abs(others[i] - some[i]));
    return most;
}

/// Vortices of Taylor and Green in the plane of two axes: exp(-2 nu k^2 t).
void expect_vortices_decay(int a, int b) {
    const int n = 32;
    Eigen::Vector3i size(n, n, n);
    size[3 - a - b] = 3;
    Box box = box_of(size.x(), size.y(), size.z());
    box.viscosity = 0.01;
    const auto water = Water::on_cpu(box, 1);
    const double k = 2 * pi / n, u0 = 0.02;
    const auto velocity = [&](const Eigen::Vector3i& at) {
        Eigen::Vector3d u = Eigen::Vector3d::Zero();
        u[a] = u0 * std::sin(k * at[a]) * std::cos(k * at[b]);
        u[b] = -u0 * std::cos(k * at[a]) * std::sin(k * at[b]);
        return u;
    };
    for_each_cell(box, [&](const Eigen::Vector3i& at) {
        water->set_cell(at, {0.75 * u0 * u0 * (std::cos(2 * k * at[a]) + std::cos(2 * k * at[b])), velocity(at)});
    });
    const auto strength = [&] {
        double product = 0;
        for_each_cell(box, [&](const Eigen::Vector3i& at) { product += velocity(at).dot(water->cell(at).velocity); });
        return product;
    };
    advance(*water, 100);  // they began without stress
    const double before = strength();
    const int steps = 500;
    advance(*water, steps);
    EXPECT_NEAR(std::log(strength() / before) / (-2 * box.viscosity * k * k * steps), 1, 0.005) << a << b;
}

TEST(LatticeWater, VorticesDecayAsTheirViscositySays) {
    expect_vortices_decay(0, 1);
    expect_vortices_decay(1, 2);
    expect_vortices_decay(2, 0);
}

/// Water whose rows are more than a strip that is advanced at once: a flow moved along y and z, so that strips and the
/// parts of several threads begin elsewhere in it, goes on with the same bits.
TEST(LatticeWater, IsTheSameWhereverStripsAndPartsBegin) {
    constexpr int rows = 100, planes = 13;  // three strips
    const Box box = box_of(32, rows, planes);
    const auto one = Water::on_cpu(box, 1), other = Water::on_cpu(box, 3);
    const auto moved = [](const Eigen::Vector3i& at) {
        return Eigen::Vector3i(at.x(), (at.y() + 7) % rows, (at.z() + 5) % planes);
    };
    for_each_cell(box, [&](const Eigen::Vector3i& at) {
        const double x = 2 * pi * at.x() / 32, y = 2 * pi * at.y() / rows, z = 2 * pi * at.z() / planes;
        const Cell cell{0.001 * std::cos(y),
                        {0.02 * std::sin(y + z), 0.01 * std::cos(2 * x + y), 0.005 * std::sin(3 * y - 2 * z)}};
        one->set_cell(at, cell);
        other->set_cell(moved(at), cell);
    });
    advance(*one, 20);
    advance(*other, 20);
    for_each_cell(box, [&](const Eigen::Vector3i& at) {
        const Cell here = one->cell(at), there = other->cell(moved(at));
        ASSERT_EQ(here.excess, there.excess) << at.transpose();
        ASSERT_EQ(here.velocity, there.velocity) << at.transpose();
    });
}

/// Eddies add C^2 |S| to the viscosity. Here |S| = 2 k u |cos cos|, and the vortices' energy falls by 4 k^2 times the
/// mean of viscosity times |S|^2 over that of |S|^2, in which the mean of |cos|^3 is 4 / 3 pi.
TEST(LatticeWater, EddiesSlowVorticesAsSmagorinskySays) {
    constexpr int n = 32, steps = 100;
    constexpr double k = 2 * pi / n, u0 = 0.04, smagorinsky = 0.4;
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        Eigen::Vector3i size(n, n, n);
        size[3 - a - b] = 1;
        Box box = box_of(size.x(), size.y(), size.z());
        box.viscosity = 2e-3;
        box.smagorinsky = smagorinsky;
        const auto water = Water::on_cpu(box, 1);
        for_each_cell(box, [&](const Eigen::Vector3i& at) {
            Eigen::Vector3d u = Eigen::Vector3d::Zero();
            u[a] = u0 * std::sin(k * at[a]) * std::cos(k * at[b]);
            u[b] = -u0 * std::cos(k * at[a]) * std::sin(k * at[b]);
            water->set_cell(at, {0.75 * u0 * u0 * (std::cos(2 * k * at[a]) + std::cos(2 * k * at[b])), u});
        });
        const auto energy = [&] {
            double sum = 0;
            for_each_cell(box, [&](const Eigen::Vector3i& at) { sum += water->cell(at).velocity.squaredNorm() / 2; });
            return sum / (n * n);
        };
        advance(*water, 100);  // they began without stress
        const double before = energy();
        advance(*water, steps);
        const double u = std::sqrt(before) + std::sqrt(energy());  // of the mean amplitude: energy is u^2 / 4
        const double added = smagorinsky * smagorinsky * 128 / (9 * pi * pi) * k * u;
        const double measured = std::log(energy() / before) / (-4 * k * k * steps);
        EXPECT_NEAR(measured / (box.viscosity + added), 1, 0.02) << a;
    }
}

/// Flow between walls, half a cell beyond the outer centres, after a start at rest under nothing but a moving layer in
/// the middle; with eddies by Smagorinsky's constant.
void expect_shear_is_linear(int n, double viscosity, double smagorinsky, double speed, int steps) {
    for (int axis = 0; axis < 3; ++axis) {
        const int along = (axis + 1) % 3;
        Eigen::Vector3i size(4, 4, 4);
        size[axis] = n;
        Box box = box_of(size.x(), size.y(), size.z());
        box.faces[axis][0] = Face::no_slip;
        box.faces[axis][1] = Face::free_slip;
        box.viscosity = viscosity;
        box.smagorinsky = smagorinsky;
        const auto water = Water::on_cpu(box, 1);
        // A slab of body, cubes of a cell each, at the middle, moves along.
        std::vector<Cube> cubes;
        const int middle = 8;
        for_each_cell(box, [&](const Eigen::Vector3i& at) {
            if (at[axis] != middle) return;
            Cube cube{};
            for (int a = 0; a < 3; ++a) {
                cube.x[a] = static_cast<float>(at[a]);
                cube.to_rest[4 * a] = 2;
                cube.reach[a] = 0.5f;
            }
            cube.v[along] = static_cast<float>(speed);
            cubes.push_back(cube);
        });
        std::vector<Push> pushes;
        for (int k = 0; k < steps; ++k) water->advance(cubes, 1, pushes);
        double drag = 0;
        for (const Push& push : pushes) drag -= push.j[along];
        const double gradient = speed / (middle + 0.5), area = 16;
        Eigen::Vector3i at(1, 1, 1);
        for (int i = 0; i < n; ++i) {
            at[axis] = i;
            // The forced layer's velocity is the mean before and after the force: half of the force of a step less.
            const double expected = i < middle ? gradient * (i + 0.5) : speed;
            EXPECT_NEAR(water->cell(at).velocity[along] / speed, expected / speed, 0.02) << axis << ' ' << i;
        }
        const double with_eddies = viscosity + smagorinsky * smagorinsky * gradient;
        EXPECT_NEAR(drag / (with_eddies * gradient * area), 1, 0.02) << axis;
    }
}
TEST(LatticeWater, ShearBetweenWallsIsLinear) {
    expect_shear_is_linear(17, 0.15, 0, 0.01, 3000);
}
TEST(LatticeWater, EddiesAddSmagorinskysViscosityToShear) {
    expect_shear_is_linear(9, 0.003, 0.5, 0.1, 12000);
}

class LatticeBar : public ::testing::Test, protected Bar {};

TEST_F(LatticeBar, GivesItsMomentumToTheWater) {
    for (auto& ends : box_.faces) ends[0] = ends[1] = Face::periodic;
    const auto water = Water::on_cpu(box_, 1);
    begin({0.03, 0, 0.01}, {0, 0.004, 0});
    const Eigen::Vector3d at_first = momentum_of_bar();
    for (int k = 0; k < 300; ++k) advance(*water);
    // The water in the bar stands for the bar: what is lost or gained are cells that it holds more or less than its
    // volume.
    EXPECT_LT(momentum_of_bar().norm(), 0.6 * at_first.norm());
    EXPECT_LT((momentum(*water) - at_first).norm(), 0.05 * at_first.norm());
}

/// Led, it gives the water what the water takes: cells that it comes to lie in, and those that it leaves, are counted
/// once.
TEST_F(LatticeBar, LosesWhatTheWaterGains) {
    for (auto& ends : box_.faces) ends[0] = ends[1] = Face::periodic;
    const Eigen::Vector3d v(0.04, 0.01, 0.02);
    begin(v, Eigen::Vector3d::Zero());
    const auto water = Water::on_cpu(box_, 1);
    std::vector<Push> pushes;
    Eigen::Vector3d at_first = Eigen::Vector3d::Zero(), given = at_first;
    for (int k = 0; k < 200; ++k) {
        water->advance(body_->cubes(place_, velocity_, box_, 1), 1, pushes);
        if (k == 50) at_first = momentum(*water);  // the start is a blow
        for (const Eigen::Vector3d& impulse : body_->impulses(pushes, box_, 1))
            if (k > 50) given -= impulse;
        for (Eigen::Vector3d& x : place_) x += v;
    }
    EXPECT_GT(given.norm(), 3);
    EXPECT_LT((momentum(*water) - at_first - given).norm(), 0.01 * given.norm()) << given.transpose();
}

/// Water and bar moved together go on as before.
TEST_F(LatticeBar, GoesOnAfterAShift) {
    const auto run = [&](int by) {
        const auto places = place_;
        const Eigen::Vector3d v(0.1, 0.07, 0.05);
        begin(v, Eigen::Vector3d::Zero());
        const auto water = Water::on_cpu(box_, 1);
        std::vector<Push> pushes;
        std::vector<Eigen::Vector3d> sums;
        for (int k = 0; k < 17; ++k) {  // then echoes of the walls are there
            water->advance(body_->cubes(place_, velocity_, box_, 1), 1, pushes);
            for (Eigen::Vector3d& x : place_) x += v;
            Eigen::Vector3d sum = Eigen::Vector3d::Zero();
            for (const Eigen::Vector3d& impulse : body_->impulses(pushes, box_, 1)) sum += impulse;
            sums.push_back(sum);
            if (k % 4 != 3) continue;
            water->shift({by, 0, 0});
            for (Eigen::Vector3d& x : place_) x.x() -= by;
        }
        place_ = places;
        return sums;
    };
    const auto here = run(0), shifted = run(1);
    for (std::size_t k = 0; k < here.size(); ++k) EXPECT_LT((shifted[k] - here[k]).norm(), 1e-3 * here[k].norm()) << k;
}

TEST_F(LatticeBar, GoesAlongWithWaterThatMoves) {
    for (auto& ends : box_.faces) ends[0] = ends[1] = Face::periodic;
    const auto water = Water::on_cpu(box_, 1);
    const Eigen::Vector3d u(0.05, 0.02, -0.03);
    for_each_cell(box_, [&](const Eigen::Vector3i& at) { water->set_cell(at, {0, u}); });
    begin(u, Eigen::Vector3d::Zero());
    for (int k = 0; k < 300; ++k) advance(*water);
    EXPECT_LT((momentum_of_bar() / (mass * static_cast<double>(place_.size())) - u).norm(), 1e-5);
}

/// Thrust on a plate, 48 x 2 cells, along which a wave goes, of the plate's length times half the square of its speed
/// through the water, 0.04; it goes across the cells at `part` of that, the water against it at the rest.
double thrust_of_wave(double part) {
    constexpr int length = 48, thickness = 2, beat = 760, beats = 5;
    constexpr double speed = 0.04, amplitude = 8, k = 2 * pi / length, w = 2 * pi / beat;
    Box box = box_of(320, 1, 96);
    box.faces[2][0] = box.faces[2][1] = Face::free_slip;
    box.viscosity = 7e-4;
    std::vector<Eigen::Vector3d> rest;
    for (int x = 0; x < length; ++x)
        for (int z = 0; z < thickness; ++z) rest.emplace_back(x + 0.5 * (1 - length), 0, z + 0.5 * (1 - thickness));
    const Immersed plate(rest, std::vector<int>(rest.size(), 0), std::vector<double>(rest.size(), 1), 1.75,
                         surface_offset);
    const auto water = Water::on_cpu(box, 1);
    water->set_cells({0, {(part - 1) * speed, 0, 0}});
    double sum = 0;
    for (int t = 1; t <= beats * beat; ++t) {
        const double ramp = std::min(1.0, static_cast<double>(t) / beat), rate = t < beat ? 1.0 / beat : 0;
        std::vector<Eigen::Vector3d> places, velocities;
        for (const Eigen::Vector3d& at : rest) {
            const double here = amplitude * (0.15 + 0.85 * (0.5 - at.x() / length)), angle = k * at.x() + w * t;
            places.push_back(at + Eigen::Vector3d(128.37 + part * speed * t, 0, 47.71 + here * ramp * std::sin(angle)));
            velocities.emplace_back(part * speed, 0, here * (ramp * w * std::cos(angle) + rate * std::sin(angle)));
        }
        std::vector<Push> pushes;
        water->advance(plate.cubes(places, velocities, box, 1), 1, pushes);
        if (t <= 3 * beat) continue;
        for (const Push& push : pushes) sum += push.j[0];
    }
    return sum / ((beats - 3) * beat) / (0.5 * speed * speed * length);
}

/// Whether it crosses cells or the water does. When what it covers goes all to the water, the thrusts are 0.078 and
/// 0.041, when all to the body, -0.018 and 0.003; with cells and steps a third as large both are 0.036.
TEST(LatticeWater, AWaveIsPushedAlikeInStillWaterAndInACurrent) {
    const double still = thrust_of_wave(1), current = thrust_of_wave(0);
    EXPECT_NEAR(still, current, 0.1 * std::abs(still));
    EXPECT_NEAR(still, 0.036, 0.005);
}

/// As in water that is not shifted, in the middle of a box so wide that its ends do not matter yet: it leaves cells and
/// comes back to them, which have moved on meanwhile.
TEST_F(LatticeBar, IsPushedTheSameWhenItsWaterIsShifted) {
    const auto run = [&](const Eigen::Vector3i& by) {
        Bar bar;
        bar.begin({0.05, 0.03, 0.02}, {0.001, 0.004, 0});
        const auto water = Water::on_cpu(bar.box_, 1);
        for (int k = 0; k < 4; ++k) bar.advance(*water);
        water->shift(by);
        std::vector<double> pushed;
        for (const Eigen::Vector3d& to :
             {Eigen::Vector3d(0.6, 0.6, 0.6), Eigen::Vector3d(-0.6, -0.6, -0.6), Eigen::Vector3d(0, 0, 0)}) {
            for (Eigen::Vector3d& place : bar.place_)
                place += to - (pushed.empty() ? by : Eigen::Vector3i(0, 0, 0)).cast<double>();
            std::vector<Push> pushes;
            water->advance(bar.cubes(), 1, pushes);
            for (const Push& push : pushes) pushed.insert(pushed.end(), push.j, push.j + 3);
        }
        return pushed;
    };
    const std::vector<double> still = run({0, 0, 0});
    for (const Eigen::Vector3i& by :
         {Eigen::Vector3i(1, 0, 0), Eigen::Vector3i(0, -1, 0), Eigen::Vector3i(-1, 0, 1), Eigen::Vector3i(2, 2, 2)}) {
        EXPECT_LT(largest_difference(still, run(by)), 1e-5) << by.transpose();
    }
}

TEST_F(LatticeBar, IsTheSameForAnyNumberOfThreads) {
    const auto run = [&](int threads) {
        const auto places = place_, velocities = velocity_;
        begin({0.03, 0.01, 0.01}, {0.001, 0.004, 0});
        const auto water = Water::on_cpu(box_, threads);
        for (int k = 0; k < 50; ++k) advance(*water);
        const auto end = place_;
        place_ = places, velocity_ = velocities;
        return end;
    };
    EXPECT_EQ(run(1), run(3));
}

/// Its cells are in the first and the last of three strips of rows.
TEST(LatticeWater, ABodyAcrossAPeriodicEndIsPushedAsElsewhere) {
    const auto run = [](double to) {
        Bar bar;
        bar.box_ = box_of(36, 100, 28);
        bar.box_.viscosity = 0.02;
        for (Eigen::Vector3d& place : bar.place_) place.y() += to;
        bar.begin({0.05, 0.03, 0.02}, {0.001, 0.004, 0});
        const auto water = Water::on_cpu(bar.box_, 1);
        std::vector<Push> pushes;
        for (int k = 0; k < 20; ++k) water->advance(bar.cubes(), 1, pushes);
        std::vector<double> pushed;
        for (const Push& push : pushes) pushed.insert(pushed.end(), push.j, push.j + 3);
        return pushed;
    };
    const std::vector<double> inside = run(32);
    EXPECT_GT(largest_difference(inside, std::vector<double>(inside.size())), 0.01);
    EXPECT_LT(largest_difference(inside, run(88)), 1e-5);
}

TEST(LatticeWater, SaysWhenThereIsNoSuchGpu) {
    EXPECT_THROW(Water::on_gpu(box_of(4, 4, 4), 99), NoDevice);
    EXPECT_THROW(Water::on_gpu(box_of(4, 4, 4), -1), NoDevice);
}

TEST(LatticeWater, ACrushedBodyHoldsNoCells) {
    Bar bar;
    const auto water = Water::on_cpu(bar.box_, 1);
    for (Eigen::Vector3d& place : bar.place_) place.x() = 12;
    std::vector<Push> pushes;
    water->advance(bar.cubes(), 1, pushes);
    for (const Push& push : pushes) EXPECT_EQ(push.j[0], 0);
    EXPECT_EQ(water->cell({12, 11, 11}).velocity.norm(), 0);
}

/// A sphere of cubes a cell wide, surface_offset larger than 12 cells, in a periodic box of 48.
class LatticeSphere : public ::testing::Test {
protected:
    LatticeSphere() {
        for (int x = -7; x <= 7; ++x)
            for (int y = -7; y <= 7; ++y)
                for (int z = -7; z <= 7; ++z)
                    if (const Eigen::Vector3d at(x, y, z); at.norm() <= radius + surface_offset)
                        place_.push_back(centre + at);
    }
    /// Moves it for so many steps, by velocity(step, from its centre), and sums what it does to the water, of(from its
    /// centre, impulse), in the second half.
    double mean(double viscosity, int steps,
                const std::function<Eigen::Vector3d(int, const Eigen::Vector3d&)>& velocity,
                const std::function<double(const Eigen::Vector3d&, const Eigen::Vector3d&)>& of) {
        Box box = box_of(48, 48, 48);
        box.viscosity = viscosity;
        const auto water = Water::on_cpu(box, 1);
        const Immersed body(place_, std::vector<int>(place_.size(), 0), std::vector<double>(place_.size(), 1), 1.2, 0);
        std::vector<Push> pushes;
        std::vector<Eigen::Vector3d> velocities(place_.size());
        double sum = 0;
        for (int k = 0; k < steps; ++k) {
            for (std::size_t i = 0; i < place_.size(); ++i) velocities[i] = velocity(k, place_[i] - centre);
            water->advance(body.cubes(place_, velocities, box, 1), 1, pushes);
            const std::vector<Eigen::Vector3d> impulse = body.impulses(pushes, box, 1);
            for (std::size_t i = 0; i < place_.size() && 2 * k >= steps; ++i) sum -= of(place_[i] - centre, impulse[i]);
        }
        return 2 * sum / steps;
    }

    static constexpr double radius = 6;
    const Eigen::Vector3d centre{24.13, 23.79, 24.07};
    std::vector<Eigen::Vector3d> place_;
};

/// Torque 8 pi nu R^3 omega (Stokes); what is at its side a box further adds less than a per cent.
/// It has 0.92 of it, and 0.99 were it 0.2 cells larger, by which waves of plates would be slowed too much.
TEST_F(LatticeSphere, FeelsTheTorqueOfSlowSpinning) {
    const double viscosity = 1.0 / 6, spin = 0.005;
    const double torque = mean(
        viscosity, 600,
        [&](int k, const Eigen::Vector3d& arm) -> Eigen::Vector3d {
            return spin * std::min(1.0, (k + 1) / 150.0) * Eigen::Vector3d::UnitZ().cross(arm);
        },
        [](const Eigen::Vector3d& arm, const Eigen::Vector3d& impulse) { return arm.cross(impulse).z(); });
    EXPECT_NEAR(torque / (8 * std::numbers::pi * viscosity * std::pow(radius, 3) * spin), 1, 0.1);
}

/// Half its water's mass, a fifth for Basset's force by then, and what sticks to its cells; it hardly leaves its place.
TEST_F(LatticeSphere, MovesWaterAlong) {
    const double pull = 1e-5;
    const double force = mean(
        2e-4, 400, [&](int k, const Eigen::Vector3d&) -> Eigen::Vector3d { return {pull * (k + 1), 0, 0}; },
        [](const Eigen::Vector3d&, const Eigen::Vector3d& impulse) { return impulse.x(); });
    const double part = force / (pull * 4 / 3 * std::numbers::pi * std::pow(radius, 3));
    EXPECT_GT(part, 0.7);
    EXPECT_LT(part, 1);
}

}  // namespace
}  // namespace natator::lattice
