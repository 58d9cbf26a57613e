// Water on a grid against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "lattice_bar.h"
#include "natator/error.h"
#include "natator/measure.h"

namespace natator {
namespace {

/// Particles of water `spacing` apart, each moved by up to `disorder` spacings along each axis, that move as `velocity`
/// says.
struct Block {
    Model model;
    State<double> state;

    template <class Velocity>
    Block(const Eigen::Vector3i& count, double spacing, double disorder, const Velocity& velocity) {
        model.parameters.fluid_rest_distance = spacing;
        std::mt19937 random(7);
        std::uniform_real_distribution<double> shift(-disorder * spacing, disorder * spacing);
        lattice::for_each_cell({.cells = count}, [&](const Eigen::Vector3i& at) {
            const Eigen::Vector3d place = spacing * (at.cast<double>() + Eigen::Vector3d::Constant(0.5)) +
                                          Eigen::Vector3d(shift(random), shift(random), shift(random));
            model.position.push_back(place);
            state.position.push_back(place);
            state.velocity.push_back(velocity(place));
        });
        model.velocity = state.velocity;
        model.inverse_mass.assign(model.position.size(), 1);
        model.phase.assign(model.position.size(), phase::fluid);
    }
};

Eigen::Vector3d centre(const WaterField& field, const Eigen::Vector3i& at) {
    return field.corner + field.cell * (at.cast<double>() + Eigen::Vector3d::Constant(0.5));
}

/// The largest error of a velocity two cells and more from the edges.
template <class Velocity>
double largest_error(const WaterField& field, const Velocity& velocity) {
    double largest = 0;
    std::size_t i = 0;
    lattice::for_each_cell({.cells = field.cells}, [&](const Eigen::Vector3i& at) {
        const std::size_t cell = i++;
        if ((at.array() < 2).any() || (at.array() >= field.cells.array() - 2).any()) return;
        largest =
            std::max(largest, (field.velocity[cell].template cast<double>() - velocity(centre(field, at))).norm());
    });
    return largest;
}

TEST(WaterField, AUniformFlowIsUniform) {
    const auto velocity = [](const Eigen::Vector3d&) { return Eigen::Vector3d(1, -2, 0.5); };
    const Block block({8, 6, 7}, 0.1, 0.3, velocity);
    EXPECT_LT(largest_error(water_field(block.model, block.state), velocity), 1e-5);  // rounding of floats
}

TEST(WaterField, ItsCellsAreInOrder) {
    const auto velocity = [](const Eigen::Vector3d& place) -> Eigen::Vector3d { return place; };
    const Block block({9, 7, 8}, 0.1, 0, velocity);
    const WaterField field = water_field(block.model, block.state);
    EXPECT_EQ(field.cells, Eigen::Vector3i(9, 7, 8));
    EXPECT_EQ(field.cell, 0.1);
    EXPECT_LT(field.corner.norm(), 1e-12);
    EXPECT_LT(largest_error(field, velocity), 1e-5);  // neighbours stand symmetrically
}

/// Vortices of Taylor and Green: Shepard's mean is of second order where neighbours stand evenly.
TEST(WaterField, ErrorsFallWithTheSquareOfTheSpacing) {
    const auto velocity = [](const Eigen::Vector3d& x) {
        const double k = 2 * std::numbers::pi;
        return Eigen::Vector3d(std::sin(k * x.x()) * std::cos(k * x.y()), -std::cos(k * x.x()) * std::sin(k * x.y()),
                               0);
    };
    double error[2];
    for (int fine = 0; fine < 2; ++fine) {
        const int n = 20 << fine;
        const Block block({n, n, 8}, 1.0 / n, 0, velocity);
        error[fine] = largest_error(water_field(block.model, block.state), velocity);
    }
    EXPECT_NEAR(error[0] / error[1], 4, 0.4);
    EXPECT_LT(error[1], 0.01);  // (k h)^2 / 6 times the second moment of the kernel, which is below 1
}

TEST(WaterField, WaterThatClosesUpHasNoEnds) {
    const auto velocity = [](const Eigen::Vector3d&) { return Eigen::Vector3d(0, 0, 1); };
    Block block({10, 9, 8}, 0.1, 0, velocity);
    const auto ends = [&](const WaterField& field) {
        return field.density.front() / field.density[field.density.size() / 2];
    };
    EXPECT_LT(ends(water_field(block.model, block.state)), 0.9f);
    block.model.periodic = {{0, 0, 1}, {2, 0, 0.8}};
    const WaterField field = water_field(block.model, block.state);
    EXPECT_EQ(field.cells, Eigen::Vector3i(10, 9, 8));
    const std::size_t middle = (static_cast<std::size_t>(4) * 9 + 4) * 10;
    EXPECT_NEAR(field.density[middle], field.density[middle + 5], 1e-6);
    double sum = 0;  // of the kernel over a lattice
    for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
            for (int z = -1; z <= 1; ++z) {
                const double q = std::sqrt(x * x + y * y + z * z) / 2;
                sum += 21 / (16 * std::numbers::pi) * std::pow(1 - q, 4) * (4 * q + 1);
            }
    EXPECT_NEAR(field.density[middle], sum, 1e-5);
}

/// A column at rest: what is linear is exact where neighbours stand evenly.
TEST(WaterField, PressureIsTheMeanOfTheParticles) {
    const auto still = [](const Eigen::Vector3d&) -> Eigen::Vector3d { return Eigen::Vector3d::Zero(); };
    Block block({8, 9, 7}, 0.1, 0, still);
    EXPECT_TRUE(water_field(block.model, block.state).pressure.empty());
    std::vector<double> pressures;
    for (const Eigen::Vector3d& place : block.state.position) pressures.push_back(9.81 * (0.9 - place.y()));
    const WaterField field = water_field(block.model, block.state, pressures);
    std::size_t i = 0;
    lattice::for_each_cell({.cells = field.cells}, [&](const Eigen::Vector3i& at) {
        const std::size_t cell = i++;
        if (at.y() < 1 || at.y() > 7) return;  // whose neighbours are to one side
        EXPECT_NEAR(field.pressure[cell], 9.81 * (0.9 - centre(field, at).y()), 1e-5) << at;
    });
    ASSERT_EQ(i, field.pressure.size());
    block.model.periodic = {{0, 0, 2}};  // half of it air
    const WaterField half = water_field(block.model, block.state, pressures);
    EXPECT_TRUE(std::isnan(half.pressure[15]));
    EXPECT_FALSE(std::isnan(half.pressure[4]));
}

TEST(WaterField, NoWaterHasNoCellsAndScatteredWaterTooMany) {
    EXPECT_EQ(water_field(Model{}, State<float>{}).cells, Eigen::Vector3i::Zero());
    Block block({2, 2, 2}, 0.1, 0, [](const Eigen::Vector3d&) -> Eigen::Vector3d { return Eigen::Vector3d::Zero(); });
    block.state.position.back() = {100, 100, 100};
    EXPECT_THROW(water_field(block.model, block.state), InputError);
}

TEST(WaterField, ALatticeTellsAllOfItsCells) {
    lattice::Box box = lattice::box_of(5, 3, 4);
    box.viscosity = 0.01;
    const auto water = lattice::Water::on_cpu(box, 1);
    lattice::for_each_cell(
        box, [&](const Eigen::Vector3i& at) { water->set_cell(at, {0.01 * at.x(), 0.01 * at.cast<double>()}); });
    std::vector<lattice::Push> pushes;
    water->advance({}, 1, pushes);
    const std::vector<Eigen::Vector4f> cells = water->cells();
    ASSERT_EQ(cells.size(), 60u);
    std::size_t i = 0;
    lattice::for_each_cell(box, [&](const Eigen::Vector3i& at) {
        const lattice::Cell cell = water->cell(at);
        EXPECT_NEAR(cells[i][0], 1 + cell.excess, 1e-6) << at;
        EXPECT_LT((cells[i++].tail<3>().cast<double>() - cell.velocity).norm(), 1e-7) << at;
    });
}

}  // namespace
}  // namespace natator
