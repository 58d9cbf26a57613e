// Water on a lattice by the GPU against the CPU's.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "../native/lattice_bar.h"
#include "gpu_test.h"
#include "natator/error.h"

namespace natator::lattice {
namespace {

using GpuLattice = test::OnGpu<>;

/// Waves along each axis, some of them sound.
void stir(Water& water) {
    const Eigen::Vector3i n = water.box().cells;
    for_each_cell(water.box(), [&](const Eigen::Vector3i& at) {
        const Eigen::Array3d wave = 2 * std::numbers::pi * (at.cast<double>().array() + 0.3) / n.cast<double>().array();
        const Eigen::Array3d s = wave.sin(), c = wave.cos();
        water.set_cell(
            at, {0.01 * s.x() * c.y(), 0.05 * Eigen::Vector3d(s.y() * c.z(), s.z() * c.x(), s.x() + c.y() * s.z())});
    });
}

/// Of velocities and densities, of the greatest velocity.
double max_difference(const Water& a, const Water& b) {
    double most = 0, scale = 0;
    const std::vector<Eigen::Vector4f> of_a = a.cells(), of_b = b.cells();
    for (std::size_t i = 0; i < of_a.size(); ++i) {
        const Eigen::Vector4d difference = (of_a[i] - of_b.at(i)).cast<double>();
        const double largest = std::max(difference.tail<3>().norm(), std::abs(difference[0]));
        if (!(largest <= most)) most = largest;  // also for NaN
        scale = std::max(scale, of_a[i].tail<3>().cast<double>().norm());
    }
    return most / scale;
}
double max_difference(const std::vector<Push>& a, const std::vector<Push>& b) {
    double most = 0, scale = 0;
    for (std::size_t p = 0; p < a.size(); ++p)
        for (int k = 0; k < 12; ++k) {
            const auto of = [&](const Push& push) { return k < 3 ? push.j[k] : push.moment[k - 3]; };
            const double difference = std::abs(of(a[p]) - of(b[p]));
            if (!(difference <= most)) most = difference;
            scale = std::max(scale, std::abs(of(a[p])));
        }
    return most / scale;
}

TEST_F(GpuLattice, FlowsAsOnTheCpuBetweenEndsOfAllKinds) {
    constexpr Face kinds[] = {Face::periodic, Face::free_slip, Face::no_slip, Face::open};
    for (const Eigen::Vector3i& size :
         {Eigen::Vector3i(13, 10, 7), Eigen::Vector3i(9, 1, 12), Eigen::Vector3i(40, 2, 1)})
        for (const Face x : kinds)
            for (const Face y : kinds)
                for (const Face z : kinds) {
                    Box box = box_of(size.x(), size.y(), size.z());
                    const Face faces[3] = {x, y, z};
                    for (int a = 0; a < 3; ++a) box.faces[a][0] = box.faces[a][1] = faces[a];
                    // Different ones at the two ends of an axis, too.
                    if (x == Face::no_slip) box.faces[0][1] = Face::free_slip;
                    if (z == Face::free_slip) box.faces[2][1] = Face::no_slip;
                    if (x == Face::open && y == Face::no_slip) box.faces[0][1] = Face::no_slip;
                    if (y == Face::open && z == Face::open) box.faces[1][0] = Face::free_slip;
                    box.viscosity = 0.01;
                    box.current = {0.03, -0.02, 0.01};
                    const auto cpu = Water::on_cpu(box, 1), gpu = Water::on_gpu(box, 0);
                    std::vector<Push> pushes;
                    for (Water* water : {cpu.get(), gpu.get()}) {
                        stir(*water);
                        for (int k = 0; k < 100; ++k) water->advance({}, 1, pushes);
                    }
                    EXPECT_LT(max_difference(*cpu, *gpu), 1e-4) << size.transpose() << ": " << static_cast<int>(x)
                                                                << static_cast<int>(y) << static_cast<int>(z);
                }
}

TEST_F(GpuLattice, HasTheEddiesOfTheCpu) {
    Box box = box_of(13, 10, 7);
    box.faces[2][0] = box.faces[2][1] = Face::no_slip;
    box.viscosity = 1e-4;
    const auto plain = Water::on_gpu(box, 0);
    box.smagorinsky = 0.2;
    const auto cpu = Water::on_cpu(box, 1), gpu = Water::on_gpu(box, 0);
    std::vector<Push> pushes;
    for (Water* water : {plain.get(), cpu.get(), gpu.get()}) {
        stir(*water);
        for (int k = 0; k < 100; ++k) water->advance({}, 1, pushes);
    }
    EXPECT_LT(max_difference(*cpu, *gpu), 1e-4);
    EXPECT_GT(max_difference(*plain, *gpu), 1e-2);
}

/// Steps of a bar that moves as the CPU's water lets it, after some of which both waters are shifted by a cell; back in
/// a step, then on, so that it comes to lie in cells that it left.
void expect_same_pushes(const Face face, bool shifts) {
    Bar bar;
    for (auto& ends : bar.box_.faces) ends[0] = ends[1] = face;
    bar.box_.current = {0.03, -0.02, 0.01};
    const auto cpu = Water::on_cpu(bar.box_, 1), gpu = Water::on_gpu(bar.box_, 0);
    stir(*cpu);
    stir(*gpu);
    bar.begin({0.06, 0.02, 0.03}, {0.001, 0.008, 0});
    for (int k = 0; k < 100; ++k) {
        if (shifts && k % 10 == 9) {
            const Eigen::Vector3i by(k % 20 == 9 ? 1 : -1, k % 30 == 9 ? 1 : 0, -(k / 50));
            cpu->shift(by);
            gpu->shift(by);
            for (Eigen::Vector3d& place : bar.place_) place -= by.cast<double>();
        }
        const double back = k % 7 == 0 ? -0.7 : k % 7 == 1 ? 0.7 : 0;
        for (Eigen::Vector3d& place : bar.place_) place.x() += back;
        std::vector<Push> by_cpu, by_gpu;
        cpu->advance(bar.cubes(), 1, by_cpu);
        gpu->advance(bar.cubes(), 1, by_gpu);
        ASSERT_LT(max_difference(by_cpu, by_gpu), 1e-4) << k;
        bar.move(by_cpu);
    }
    EXPECT_LT(max_difference(*cpu, *gpu), 1e-4);
}
TEST_F(GpuLattice, PushesABarAsOnTheCpu) {
    expect_same_pushes(Face::periodic, false);
    expect_same_pushes(Face::free_slip, false);
    expect_same_pushes(Face::no_slip, false);
    expect_same_pushes(Face::open, false);
}
/// A box whose face lies between cells so that rounding decides who is its neighbour: 5.9 + 8.5 cells.
TEST_F(GpuLattice, PushesABoxAsOnTheCpu) {
    Box box = box_of(24, 26, 28, Face::no_slip);
    box.cell = 0.02;
    box.viscosity = 4e-6;
    Obstacle obstacle;
    obstacle.shape = Obstacle::Shape::box;
    obstacle.centre = {0.118, 0.26, 0.28};
    obstacle.size = {0.34, 0.16, 0.12};
    const std::vector<Cube> cubes = cubes_of(obstacle, box);
    const auto cpu = Water::on_cpu(box, 1), gpu = Water::on_gpu(box, 0);
    stir(*cpu);
    stir(*gpu);
    for (int k = 0; k < 20; ++k) {
        std::vector<Push> by_cpu, by_gpu;
        cpu->advance(cubes, 1, by_cpu);
        gpu->advance(cubes, 1, by_gpu);
        ASSERT_LT(max_difference(by_cpu, by_gpu), 1e-4) << k;
    }
}
TEST_F(GpuLattice, TellsAllOfItsCells) {
    Box box = box_of(13, 10, 7);
    box.viscosity = 0.01;
    const auto here = Water::on_cpu(box, 1), there = Water::on_gpu(box, 0);
    stir(*here);
    stir(*there);
    const std::vector<Eigen::Vector4f> cells = there->cells();
    ASSERT_EQ(cells.size(), 910u);
    EXPECT_LT(max_difference(*here, *there), 1e-5);
    std::size_t i = 0;
    for_each_cell(box, [&](const Eigen::Vector3i& at) {
        const Cell cell = there->cell(at);
        EXPECT_NEAR(cells[i][0], 1 + cell.excess, 1e-6) << at;
        EXPECT_LT((cells[i++].tail<3>().cast<double>() - cell.velocity).norm(), 1e-6) << at;
    });
}

/// Through open ends on all sides.
TEST_F(GpuLattice, ACurrentGoesOn) {
    Box box = box_of(12, 10, 11, Face::open);
    box.viscosity = 0.01;
    box.current = {0.05, -0.03, 0.02};
    const auto water = Water::on_gpu(box, 0);
    water->set_cells({0, box.current});
    std::vector<Push> pushes;
    for (int k = 0; k < 100; ++k) water->advance({}, 1, pushes);
    for_each_cell(box, [&](const Eigen::Vector3i& at) {
        const Cell cell = water->cell(at);
        EXPECT_LT((cell.velocity - box.current).norm(), 1e-6);
        EXPECT_LT(std::abs(cell.excess), 1e-6);
    });
}

TEST_F(GpuLattice, IsShiftedAsOnTheCpu) {
    expect_same_pushes(Face::periodic, true);
    expect_same_pushes(Face::no_slip, true);
}

/// More cubes than before, fewer, none, at the ends of the box and beyond them.
TEST_F(GpuLattice, TakesBodiesThatComeAndGo) {
    Box box = box_of(20, 16, 12, Face::no_slip);
    box.viscosity = 0.02;
    const auto cpu = Water::on_cpu(box, 1), gpu = Water::on_gpu(box, 0);
    stir(*cpu);
    stir(*gpu);
    const auto cubes_of = [](int count, double along) {
        std::vector<Cube> cubes(count);
        for (int k = 0; k < count; ++k) {
            Cube& cube = cubes[k];
            cube.x[0] = static_cast<float>(along + 1.5 * (k % 5)),
            cube.x[1] = static_cast<float>(5 + 1.5 * (k / 5 % 5)), cube.x[2] = static_cast<float>(-1 + 1.5 * (k / 25));
            for (int a = 0; a < 3; ++a) {
                cube.v[a] = 0.01f * static_cast<float>(a - 1), cube.to_rest[4 * a] = 1 / 0.8f, cube.reach[a] = 0.8f;
                cube.rate[4 * a] = 0.003f, cube.rate[(4 * a + 1) % 9] = 0.002f;
            }
        }
        return cubes;
    };
    int step = 0;
    for (const auto& [count, along] : {std::pair{3, 4.0},
                                       {40, 4.2},
                                       {200, 4.6},
                                       {60, 10.2},
                                       {0, 0.0},
                                       {30, 17.0},
                                       {30, -30.0},
                                       {30, 40.0},
                                       {200, -2.5},
                                       {1, 8.0},
                                       {0, 0.0},
                                       {100, 8.0}})
        for (int k = 0; k < 3; ++k, ++step) {
            std::vector<Push> by_cpu, by_gpu;
            cpu->advance(cubes_of(count, along), 1, by_cpu);
            gpu->advance(cubes_of(count, along), 1, by_gpu);
            ASSERT_EQ(by_cpu.size(), by_gpu.size());
            bool any = false;
            for (const Push& push : by_cpu) any = any || push.j[0] != 0;
            if (any) {
                EXPECT_LT(max_difference(by_cpu, by_gpu), 1e-4) << step;
            }
            for (const Push& push : by_gpu) ASSERT_TRUE(any || push.j[0] == 0) << step;
        }
    EXPECT_LT(max_difference(*cpu, *gpu), 1e-4);
}

TEST_F(GpuLattice, HasTheSameBitsInEachRun) {
    const auto run = [] {
        Bar bar;
        bar.begin({0.06, 0.02, 0.03}, {0.001, 0.008, 0});
        const auto water = Water::on_gpu(bar.box_, 0);
        stir(*water);
        for (int k = 0; k < 100; ++k) bar.advance(*water);
        return bar.place_;
    };
    EXPECT_EQ(run(), run());
}

/// Of so many cells that numbers of populations need 64 bits.
TEST_F(GpuLattice, HasRoomForManyCells) {
    const auto begun = [](const Eigen::Vector3i& cells) {
        Box box = box_of(cells.x(), cells.y(), cells.z());
        box.viscosity = 0.01;
        auto water = Water::on_gpu(box, 0);
        water->set_cell(cells - Eigen::Vector3i(1, 1, 1), {0.01, {0.02, -0.03, 0.05}});
        std::vector<Push> pushes;
        for (int k = 0; k < 3; ++k) water->advance({}, 1, pushes);
        return water;
    };
    const Eigen::Vector3i few(9, 8, 10), many(1000, 410, 400);
    std::unique_ptr<Water> large;
    try {
        large = begun(many);
    } catch (const std::bad_alloc&) {
        GTEST_SKIP() << "no room for 164 million cells on this GPU";
    }
    const auto small = begun(few);
    double most = 0;
    for (int x = -3; x <= 3; ++x)
        for (int y = -3; y <= 3; ++y)
            for (int z = -3; z <= 3; ++z) {  // around the last cell, beyond all ends
                const auto of = [&](const Water& water) {
                    const Eigen::Vector3i n = water.box().cells, last = n - Eigen::Vector3i(1, 1, 1);
                    return water.cell({(last.x() + x) % n.x(), (last.y() + y) % n.y(), (last.z() + z) % n.z()})
                        .velocity;
                };
                EXPECT_EQ(of(*large), of(*small)) << x << ' ' << y << ' ' << z;
                most = std::max(most, of(*small).norm());
            }
    EXPECT_GT(most, 1e-4);
}

/// A cube beside water that has no numbers, or is far too dense, is pushed by no number; others as before.
TEST_F(GpuLattice, PushesOfBadWaterAreNoNumbers) {
    Bar bar;
    std::vector<Push> pushes;
    for (const double excess : {std::nan(""), 1e6}) {
        const auto water = Water::on_gpu(bar.box_, 0);
        water->advance(bar.cubes(), 1, pushes);
        for (const Push& push : pushes) ASSERT_LT(std::abs(push.j[0]), 1e-6);
        water->set_cell({8, 10, 10}, {excess, {0, 0, 0}});
        for (int k = 0; k < 3; ++k) water->advance(bar.cubes(), 1, pushes);
        EXPECT_TRUE(std::isnan(pushes.front().j[0])) << excess;
        EXPECT_LT(std::abs(pushes.back().j[0]), 1e-6) << excess;
    }
}

TEST_F(GpuLattice, SaysWhatItHasNoRoomFor) {
    EXPECT_THROW(Water::on_gpu(box_of(2000, 1000, 1000), 0), std::bad_alloc);
    EXPECT_THROW(Water::on_gpu(box_of(4000, 4000, 4000), 0), std::bad_alloc);
}

}  // namespace
}  // namespace natator::lattice
