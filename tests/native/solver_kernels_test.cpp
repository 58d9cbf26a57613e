// The vector kernels against the same formulas particle by particle.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "solver/cpu/aligned.h"
#include "solver/cpu/fluid_kernels.h"
#include "solver/cpu/motion_kernels.h"
#include "solver/cpu/neighbour_kernels.h"
#include "solver/cpu/plane_kernels.h"
#include "solver/water/cpu/water_kernels.h"

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
        for (auto* array : {&inverse_mass, &solid_density, &density, &compression, &constraint_count, &volume, &solid,
                            &response, &target, &impulse, &impulse_sum, &max_speed_square, &zeroth_order_correction})
            array->resize(slots);
        crowding.resize(slots);
        zeroth.resize(slots);
        for (auto& array : water_correction) array.resize(slots);
        for (auto* array : {&packed, &packed_velocity, &packed_correction, &packed_shear, &packed_zeroth_order})
            array->resize(4 * slots);
        for (int slot = 0; slot < far_slot; ++slot) {
            position.set(slot, {place(random), place(random), place(random)});
            velocity.set(slot, {place(random), place(random), place(random)});
            inverse_mass[slot] = positive(random);
            solid_density[slot] = positive(random) - 0.1f;
            volume[slot] = 2e-2f * positive(random);
            solid[slot] = slot % 5 == 0 ? 1.0f : 0.0f;
            target[slot] = 0.1f * positive(random);
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
        gradient.resize(neighbour.size());
    }

    FluidView<float> view() {
        const auto pointers = [](auto& array) { return std::array{array.x.data(), array.y.data(), array.z.data()}; };
        const auto x = pointers(position), u = pointers(velocity), dx = pointers(correction);
        return {.first_block = 0,
                .end_block = blocks,
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

    WaterView<float> water_view() {
        const auto pointers = [](auto& array) { return std::array{array.x.data(), array.y.data(), array.z.data()}; };
        const auto x = pointers(position), v = pointers(velocity), s = pointers(crowding), g = pointers(gradient),
                   z = pointers(zeroth);
        WaterView<float> view{.first_block = 0,
                              .end_block = blocks,
                              .row_begin = row_begin.data(),
                              .neighbour = neighbour.data(),
                              .far_slot = far_slot,
                              .inverse_radius = 1 / radius,
                              .kernel_scale = 90,
                              .slope_scale = 20 * 90 / (radius * radius),
                              .at_spacing = 0.05f,
                              .softening = 1e-4f,
                              .position = {x[0], x[1], x[2]},
                              .volume = volume.data(),
                              .inverse_mass = inverse_mass.data(),
                              .mobility = inverse_mass.data(),
                              .solid = solid.data(),
                              .velocity = {v[0], v[1], v[2]},
                              .density = density.data(),
                              .correction = {},
                              .crowding = {s[0], s[1], s[2]},
                              .max_speed_square = max_speed_square.data(),
                              .response = response.data(),
                              .target = target.data(),
                              .impulse = impulse.data(),
                              .impulse_sum = impulse_sum.data(),
                              .zeroth = {z[0], z[1], z[2]},
                              .zeroth_order_correction = zeroth_order_correction.data(),
                              .packed = packed.data(),
                              .packed_velocity = packed_velocity.data(),
                              .packed_correction = packed_correction.data(),
                              .packed_shear = packed_shear.data(),
                              .packed_zeroth_order = packed_zeroth_order.data(),
                              .distance = distance.data(),
                              .gradient = {g[0], g[1], g[2]}};
        for (int k = 0; k < 6; ++k) view.correction[k] = water_correction[k].data();
        return view;
    }

    Vector3Array<float> position, velocity, correction, crowding, gradient, zeroth;
    AlignedVector<float> volume, solid, response, target, impulse, impulse_sum, max_speed_square,
        zeroth_order_correction;
    AlignedVector<float> packed_correction, packed_shear, packed_zeroth_order;
    std::array<AlignedVector<float>, 6> water_correction;
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
    kernels.pack(fluid.view());
    kernels.compute_density(fluid.view());
    scalar.pack(expected.view());
    scalar.compute_density(expected.view());
    expect_near(fluid.density, expected.density);
    expect_near(fluid.compression, expected.compression);
    kernels.pack(fluid.view());
    kernels.solve_density_constraint(fluid.view());
    scalar.pack(expected.view());
    scalar.solve_density_constraint(expected.view());
    expect_near(fluid.correction.x, expected.correction.x);
    expect_near(fluid.correction.y, expected.correction.y);
    expect_near(fluid.correction.z, expected.correction.z);
    EXPECT_EQ(fluid.constraint_count, expected.constraint_count);
}

TEST_P(SolverKernels, Viscosity) {
    Fluid fluid, expected;
    kernels.pack(fluid.view());
    kernels.pack_velocity(fluid.view());
    kernels.smooth_velocities(fluid.view());
    scalar.pack(expected.view());
    scalar.pack_velocity(expected.view());
    scalar.smooth_velocities(expected.view());
    expect_near(fluid.correction.x, expected.correction.x);
    expect_near(fluid.correction.y, expected.correction.y);
    expect_near(fluid.correction.z, expected.correction.z);
}

TEST_P(SolverKernels, Water) {
    Fluid fluid, expected;
    const WaterView<float> view = fluid.water_view(), plain_view = expected.water_view();
    const auto by_both = [&](const auto& work) {
        work(water_kernels<float>(GetParam()), view);
        work(scalar_water_kernels<float>(GetParam()), plain_view);
    };
    by_both([](const WaterKernels<float>& set, const WaterView<float>& water) {
        set.pack(water);
        set.compute_moments(water);
        set.compute_gradients(water);
        set.add_viscosity(water, 0.1f, 1);
        set.compute_impulse(water);
        set.apply_impulse(water);
        set.apply_zeroth_order_correction(water, 1e-4f);
        set.lay_out_zeroth_order_correction(water);
        set.return_zeroth_order_correction(water);
    });
    for (const auto member :
         {&Fluid::density, &Fluid::max_speed_square, &Fluid::response, &Fluid::impulse, &Fluid::impulse_sum,
          &Fluid::zeroth_order_correction, &Fluid::packed_zeroth_order, &Fluid::packed_velocity})
        expect_near(fluid.*member, expected.*member);
    for (int k = 0; k < 6; ++k) expect_near(fluid.water_correction[k], expected.water_correction[k]);
    expect_near(fluid.crowding.x, expected.crowding.x);
    expect_near(fluid.velocity.x, expected.velocity.x);
    expect_near(fluid.velocity.y, expected.velocity.y);
    expect_near(fluid.velocity.z, expected.velocity.z);
}

/// The first pass of the divergence comes with the gradients, and has the bits of a pass by itself.
TEST_P(SolverKernels, TheFirstPassComesWithTheGradients) {
    Fluid fluid, by_itself;
    std::fill(by_itself.target.begin(), by_itself.target.end(), 0.0f);
    for (Fluid* const each : {&fluid, &by_itself}) {
        const WaterKernels<float>& set = water_kernels<float>(GetParam());
        set.pack(each->water_view());
        set.compute_moments(each->water_view());
        set.compute_gradients(each->water_view());
    }
    std::fill_n(by_itself.impulse.begin(), Fluid::far_slot, 9.0f);
    std::fill(by_itself.impulse_sum.begin(), by_itself.impulse_sum.end(), 0.0f);
    water_kernels<float>(GetParam()).compute_impulse(by_itself.water_view());
    EXPECT_EQ(fluid.impulse, by_itself.impulse);
    EXPECT_EQ(fluid.impulse_sum, by_itself.impulse_sum);
    EXPECT_GT(*std::max_element(fluid.impulse.begin(), fluid.impulse.end()), 0);
}

/// Runs of all lengths, from all places; the longest are those of a pile of particles in one cell.
TEST_P(SolverKernels, NeighboursOfRuns) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<float> place(0, 0.4f);
    constexpr int slots = 900, longest = 600;
    Vector3Array<float> x;
    x.resize(slots + block_size);
    for (int slot = 0; slot < slots; ++slot) x.set(slot, {place(random), place(random), place(random)});
    const float* const position[3] = {x.x.data(), x.y.data(), x.z.data()};
    SlotRuns runs;
    for (const auto& [begin, end] :
         {std::pair{0, 1}, {2, 2}, {3, 10}, {11, 27}, {27, 44}, {44, 44 + 256}, {300, 300 + longest}}) {
        runs.begin[runs.count] = begin;
        runs.end[runs.count++] = end;
    }
    std::vector<std::int32_t> found(slots + block_size), expected(slots + block_size);
    int all = 0;
    for (int slot = 0; slot < slots; slot += 7) {
        const int n = neighbour_kernels<float>(GetParam()).find(position, slot, runs, radius * radius, found.data());
        ASSERT_EQ(
            n,
            scalar_neighbour_kernels<float>(GetParam()).find(position, slot, runs, radius * radius, expected.data()));
        for (int k = 0; k < n; ++k) EXPECT_EQ(found[k], expected[k]);
        all += n;
        if (slot + 1 == slots) continue;
        std::vector<std::int32_t> second(slots + block_size);
        std::int32_t* const both[2] = {found.data(), second.data()};
        int count[2];
        neighbour_kernels<float>(GetParam()).find_two(position, slot, runs, radius * radius, both, count);
        ASSERT_EQ(count[0], n);
        for (int k = 0; k < n; ++k) EXPECT_EQ(found[k], expected[k]);
        ASSERT_EQ(count[1], scalar_neighbour_kernels<float>(GetParam())
                                .find(position, slot + 1, runs, radius * radius, expected.data()));
        for (int k = 0; k < count[1]; ++k) EXPECT_EQ(second[k], expected[k]);
    }
    EXPECT_GT(all, 1000);
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

/// No product is fused, so these agree to the last bit with the portable set.
TEST_P(SolverKernels, MotionIsTheSameInAllSets) {
    const MotionKernels<float>& motion = motion_kernels<float>(GetParam());
    const MotionKernels<float>& portable = motion_kernels<float>(InstructionSet::portable);
    Fluid fluid, expected;
    for (const auto& [set, particles] : {std::pair{&motion, &fluid}, {&portable, &expected}}) {
        Vector3Array<float> start = particles->position, predicted = particles->velocity;
        for (int slot = 0; slot < Fluid::far_slot; ++slot) {
            particles->correction.set(slot, 0.1f * particles->velocity.at(slot));
            particles->constraint_count[slot] = static_cast<float>(slot % 5);
        }
        const auto pointers = [](auto& array) { return std::array{array.x.data(), array.y.data(), array.z.data()}; };
        const auto x = pointers(particles->position), x0 = pointers(start), v0 = pointers(predicted),
                   dx = pointers(particles->correction), v = pointers(particles->velocity);
        const MotionView<float> slots{.first_block = 0,
                                      .end_block = Fluid::blocks,
                                      .position = {x[0], x[1], x[2]},
                                      .start = {x0[0], x0[1], x0[2]},
                                      .predicted_velocity = {v0[0], v0[1], v0[2]},
                                      .correction = {dx[0], dx[1], dx[2]},
                                      .constraint_count = particles->constraint_count.data(),
                                      .velocity = {v[0], v[1], v[2]}};
        set->relax(slots, 1, true);
        set->relax(slots, 0.1f, false);
        set->displacement_velocity(slots, 240);
        EXPECT_TRUE(set->finite(v[0], Fluid::far_slot));
        set->finish_velocity(slots, 3,
                             {.viscosity = true,
                              .viscosity_step = 0.1f,
                              .damping = true,
                              .damping_step = 0.01f,
                              .clamp_acceleration = true,
                              .max_change = 5,
                              .clamp_speed = true,
                              .max_speed = 4.5f});
    }
    EXPECT_EQ(fluid.position.x, expected.position.x);
    EXPECT_EQ(fluid.position.y, expected.position.y);
    EXPECT_EQ(fluid.position.z, expected.position.z);
    EXPECT_EQ(fluid.velocity.x, expected.velocity.x);
    EXPECT_EQ(fluid.velocity.y, expected.velocity.y);
    EXPECT_EQ(fluid.velocity.z, expected.velocity.z);
}

/// All that planes do, in one array; the same bits in all sets, as no product is fused.
std::vector<float> what_planes_do(const PlaneKernels<float>& planes, bool displaced) {
    Fluid fluid;
    Vector3Array<float> start = fluid.position, displacement = fluid.velocity;
    for (int slot = 0; slot < Fluid::far_slot; ++slot) {
        displacement.set(slot, 0.1f * fluid.velocity.at(slot));
        fluid.position.set(slot, start.at(slot) + displacement.at(slot));
    }
    const auto pointers = [](auto& array) { return std::array{array.x.data(), array.y.data(), array.z.data()}; };
    const auto x = pointers(fluid.position), x0 = pointers(start), d = pointers(displacement);
    NearPlanes<float> slots{
        .position = {x[0], x[1], x[2]}, .start = {x0[0], x0[1], x0[2]}, .base = {}, .displacement = {}};
    for (int axis = 0; axis < 3 && displaced; ++axis) {
        slots.base[axis] = x0[axis];
        slots.displacement[axis] = d[axis];
    }
    int pushed = 0;
    for (int block = 0; block < Fluid::blocks; ++block) {
        const PlaneView<float> plane{.normal = {0.6f, 0, 0.8f},
                                     .offset = -0.2f,
                                     .distance = 0.05f,
                                     .friction = block % 2 == 0,
                                     .static_friction = 0.3f,
                                     .dynamic_friction = 0.2f};
        const unsigned chosen = planes.near(slots, block, plane) & 0xbfffu;
        pushed += std::popcount(chosen);
        planes.resolve_penetration(slots, block, chosen, plane);
    }
    EXPECT_GT(pushed, 10);
    std::vector<float> all;
    for (const auto* array : {&fluid.position, &displacement})
        for (const auto* axis : {&array->x, &array->y, &array->z}) all.insert(all.end(), axis->begin(), axis->end());
    return all;
}

TEST_P(SolverKernels, PlanesDoTheSameInAllSets) {
    for (const bool displaced : {false, true}) {
        const auto expected = what_planes_do(scalar_plane_kernels<float>(InstructionSet::portable), displaced);
        EXPECT_EQ(what_planes_do(plane_kernels<float>(GetParam()), displaced), expected);
    }
}

TEST_P(SolverKernels, FiniteSeesEveryValue) {
    std::vector<float> values(37, 1);
    EXPECT_TRUE(motion_kernels<float>(GetParam()).finite(values.data(), 37));
    for (const int place : {0, 15, 16, 36}) {
        for (const float bad : {std::nanf(""), -INFINITY}) {
            std::vector<float> with_bad = values;
            with_bad[place] = bad;
            EXPECT_FALSE(motion_kernels<float>(GetParam()).finite(with_bad.data(), 37)) << place;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(AllSets, SolverKernels,
                         testing::Values(InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512,
                                         InstructionSet::neon),
                         [](const auto& set) { return to_string(set.param); });

}  // namespace
}  // namespace natator::cpu
