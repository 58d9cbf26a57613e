// The vector kernels against the plain loops that define them.
#include <gtest/gtest.h>

#include <random>

#include "solver/cpu/aligned.h"
#include "solver/cpu/fluid_kernels.h"
#include "solver/cpu/neighbour_kernels.h"

namespace natator::cpu {
namespace {

constexpr int block_size = 16;
constexpr float radius = 0.15f;

/// Random fluid with random lists of different lengths, as the fluid kernels see it.
struct Fluid {
    static constexpr int blocks = 5, far_slot = blocks * block_size, slots = far_slot + block_size;

    Fluid() {
        std::mt19937_64 random(11);
        std::uniform_real_distribution<float> place(0, 0.4f), positive(0.1f, 2);
        std::uniform_int_distribution<int> row_count(0, 40), slot_below(0, far_slot - 1);
        position.resize(slots, 1e9f);
        velocity.resize(slots);
        correction.resize(slots);
        for (auto* array : {&inverse_mass, &solid_density, &density, &compression, &constraint_count})
            array->resize(slots);
        packed.resize(4 * slots);
        packed_velocity.resize(4 * slots);
        for (int slot = 0; slot < far_slot; ++slot) {
            position.set(slot, {place(random), place(random), place(random)});
            velocity.set(slot, {place(random), place(random), place(random)});
            inverse_mass[slot] = positive(random);
            solid_density[slot] = positive(random) - 0.1f;
        }
        position.set(7, position.at(3));  // a pair at distance 0
        row_begin.push_back(0);
        for (int block = 0; block < blocks; ++block) {
            const int rows = block == 2 ? 0 : row_count(random);
            row_begin.push_back(row_begin.back() + rows);
            for (int k = 0; k < rows * block_size; ++k) {
                const int slot = slot_below(random);
                neighbour.push_back(slot % 10 == 0 ? far_slot : slot);
            }
        }
        if (!neighbour.empty()) neighbour[3] = 7;
        distance.resize(neighbour.size());
    }

    FluidView<float> view() {
        const auto pointers = [](auto& array) { return std::array{array.x.data(), array.y.data(), array.z.data()}; };
        const auto x = pointers(position), u = pointers(velocity), dx = pointers(correction);
        return {.blocks = blocks,
                .row_begin = row_begin.data(),
                .neighbour = neighbour.data(),
                .far_slot = far_slot,
                .radius = radius,
                .inverse_radius = 1 / radius,
                .density_scale = 1,
                .position = {x[0], x[1], x[2]},
                .inverse_mass = inverse_mass.data(),
                .solid_density = solid_density.data(),
                .density = density.data(),
                .compression = compression.data(),
                .correction = {dx[0], dx[1], dx[2]},
                .constraint_count = constraint_count.data(),
                .velocity = {u[0], u[1], u[2]},
                .velocity_change = {dx[0], dx[1], dx[2]},
                .packed = packed.data(),
                .packed_velocity = packed_velocity.data(),
                .distance = distance.data()};
    }

    Vector3Array<float> position, velocity, correction;
    AlignedVector<float> inverse_mass, solid_density, density, compression, constraint_count;
    AlignedVector<float> packed, packed_velocity, distance;
    std::vector<int> row_begin;
    AlignedVector<std::int32_t> neighbour;
};

/// The same sums in the same order: what is left is which products are fused with a sum.
void expect_near(const AlignedVector<float>& a, const AlignedVector<float>& b) {
    float largest = 0;
    for (int slot = 0; slot < Fluid::far_slot; ++slot) largest = std::max(largest, std::abs(b[slot]));
    EXPECT_GT(largest, 0);
    for (int slot = 0; slot < Fluid::far_slot; ++slot) EXPECT_NEAR(a[slot], b[slot], 2e-6f * largest) << slot;
}

class SolverKernels : public testing::TestWithParam<InstructionSet> {
protected:
    void SetUp() override {
        if (!available(GetParam())) GTEST_SKIP() << "this machine lacks it";
    }
    const FluidKernels<float>& kernels = fluid_kernels<float>(GetParam());
    const FluidKernels<float>& scalar = scalar_fluid_kernels<float>(GetParam());
};

TEST_P(SolverKernels, DensityAndItsConstraint) {
    Fluid fluid, expected;
    kernels.compute_density(fluid.view());
    scalar.compute_density(expected.view());
    expect_near(fluid.density, expected.density);
    expect_near(fluid.compression, expected.compression);
    kernels.solve_density_constraint(fluid.view());
    scalar.solve_density_constraint(expected.view());
    expect_near(fluid.correction.x, expected.correction.x);
    expect_near(fluid.correction.y, expected.correction.y);
    expect_near(fluid.correction.z, expected.correction.z);
    EXPECT_EQ(fluid.constraint_count, expected.constraint_count);
}

TEST_P(SolverKernels, Viscosity) {
    Fluid fluid, expected;
    kernels.smooth_velocities(fluid.view());
    scalar.smooth_velocities(expected.view());
    expect_near(fluid.correction.x, expected.correction.x);
    expect_near(fluid.correction.y, expected.correction.y);
    expect_near(fluid.correction.z, expected.correction.z);
}

/// Runs of all lengths, also empty ones, from all places.
TEST_P(SolverKernels, NeighboursOfRuns) {
    Fluid fluid;
    const FluidView<float> view = fluid.view();
    const SlotRun runs[] = {{0, 1}, {2, 2}, {3, 10}, {11, 27}, {27, 44}, {50, 80}};
    std::vector<std::int32_t> found(200), expected(200);
    int all = 0;
    for (int slot = 0; slot < Fluid::far_slot; ++slot) {
        const int n = neighbour_kernels<float>(GetParam())
                          .find(view.position, slot, runs, std::size(runs), radius * radius, found.data());
        ASSERT_EQ(n, scalar_neighbour_kernels<float>(GetParam())
                         .find(view.position, slot, runs, std::size(runs), radius * radius, expected.data()));
        for (int k = 0; k < n; ++k) EXPECT_EQ(found[k], expected[k]);
        all += n;
    }
    EXPECT_GT(all, 100);
}

TEST_P(SolverKernels, ListsSideBySide) {
    std::vector<std::vector<std::int32_t>> lists;
    const std::int32_t* list[block_size];
    int count[block_size];
    for (int lane = 0; lane < block_size; ++lane) {
        count[lane] = (lane * 7) % 38;
        lists.emplace_back(count[lane]);
        for (int k = 0; k < count[lane]; ++k) lists[lane][k] = 1000 * lane + k;
    }
    for (int lane = 0; lane < block_size; ++lane) list[lane] = lists[lane].data();
    constexpr int rows = 37;
    AlignedVector<std::int32_t> to(48 * block_size), expected(48 * block_size);
    neighbour_kernels<float>(GetParam()).interleave(list, count, rows, -1, to.data());
    scalar_neighbour_kernels<float>(GetParam()).interleave(list, count, rows, -1, expected.data());
    for (int k = 0; k < rows * block_size; ++k) EXPECT_EQ(to[k], expected[k]) << k;
    EXPECT_EQ(expected[block_size * 6 + 1], 1006);
    EXPECT_EQ(expected[block_size * 7 + 1], -1);
}

INSTANTIATE_TEST_SUITE_P(AllSets, SolverKernels,
                         testing::Values(InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512),
                         [](const auto& set) { return to_string(set.param); });

}  // namespace
}  // namespace natator::cpu
