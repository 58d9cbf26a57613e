// The same scene on a finer lattice: what is kept, and what the body's bending does.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "model/water_volumes.h"
#include "natator/measure.h"
#include "natator/model.h"
#include "natator/solver.h"
#include "run/converge/level.h"
#include "scene/scene_json.h"

namespace natator {
namespace {

using nlohmann::json;

struct BothSpacings {
    Scene coarse_scene, fine_scene;
    Model coarse, fine;
};

BothSpacings both_spacings(const std::string& name) {
    BothSpacings both;
    both.coarse_scene = load_scene(name, json::object());
    both.coarse = build_model(both.coarse_scene);
    both.fine_scene =
        load_scene(name, refined(both.coarse_scene, Level::named("spacing/2"), both.coarse.parameters.substeps));
    both.fine = build_model(both.fine_scene);
    return both;
}

double mass_of(const Model& model, const std::vector<int>& particles) {
    double mass = 0;
    for (const int i : particles) mass += 1 / model.inverse_mass[i];
    return mass;
}

Eigen::Vector3d centre_of(const Model& model, const std::vector<int>& particles) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int i : particles) sum += model.position[i];
    return sum / static_cast<double>(particles.size());
}

/// Of a box around cubes of the spacing about the particles.
Eigen::Vector3d outer_size(const Model& model, const std::vector<int>& particles, double spacing) {
    Eigen::AlignedBox3d box;
    for (const int i : particles) box.extend(model.position[i]);
    return box.sizes() + Eigen::Vector3d::Constant(spacing);
}

double volume_of_body(const Model& model) {
    const std::vector<double> volumes = particle_volumes(model);
    double volume = 0;
    for (const int i : model.body.particles) volume += volumes[i];
    return volume;
}

class Refinement : public testing::TestWithParam<int> {
protected:
    BothSpacings both = both_spacings("open-water/creature-" + std::to_string(GetParam()));
    double spacing = both.coarse_scene.creature->spacing;
};

TEST_P(Refinement, KeepsShapeMassAndVolume) {
    const Model &coarse = both.coarse, &fine = both.fine;
    ASSERT_EQ(fine.body.particles.size(), 8 * coarse.body.particles.size());
    EXPECT_EQ(fine.body.length, coarse.body.length);
    ASSERT_EQ(fine.body.slices.size(), coarse.body.slices.size());
    for (std::size_t k = 0; k < coarse.body.slices.size(); ++k) {
        const auto &slice = coarse.body.slices[k], &finer = fine.body.slices[k];
        EXPECT_NEAR(mass_of(fine, finer), mass_of(coarse, slice), 1e-12);
        EXPECT_LT((centre_of(fine, finer) - centre_of(coarse, slice)).norm(), 1e-12);
        EXPECT_LT((outer_size(fine, finer, spacing / 2) - outer_size(coarse, slice, spacing)).norm(), 1e-12);
    }
    EXPECT_NEAR(volume_of_body(fine), volume_of_body(coarse), 1e-9);
    ASSERT_EQ(fine.clusters.size(), coarse.clusters.size());
    for (std::size_t k = 0; k < coarse.clusters.size(); ++k) {
        EXPECT_EQ(fine.clusters[k].particles.size(), 8 * coarse.clusters[k].particles.size());
        EXPECT_EQ(fine.clusters[k].stiffness, coarse.clusters[k].stiffness);
        EXPECT_LT((fine.clusters[k].centre - coarse.clusters[k].centre).norm(), 1e-12);
    }
}

/// All parts of a spring have its length, and the change of length that a muscle asks for grows across the body as
/// before: lateral over z is the same.
TEST_P(Refinement, KeepsTheMuscles) {
    const Model &coarse = both.coarse, &fine = both.fine;
    ASSERT_EQ(fine.springs.size(), 8 * coarse.springs.size());
    ASSERT_EQ(fine.muscles.size(), fine.springs.size());
    using PlaceKey = std::tuple<int, int, int>;  // actuator, coarse front, coarse rear
    std::map<PlaceKey, std::pair<double, int>> lateral_before, lateral;
    const auto add = [](auto& sums, const Model& model, int parts) {
        for (const Muscle& muscle : model.muscles) {
            const Spring& spring = model.springs[muscle.spring];
            auto& [sum, count] = sums[{muscle.actuator, spring.a / parts, spring.b / parts}];
            sum += muscle.lateral;
            ++count;
        }
    };
    add(lateral_before, coarse, 1);
    add(lateral, fine, 8);
    ASSERT_EQ(lateral.size(), lateral_before.size());
    for (const auto& [key, before] : lateral_before) {
        EXPECT_EQ(lateral.at(key).second, 8 * before.second);
        EXPECT_NEAR(lateral.at(key).first / lateral.at(key).second, before.first / before.second, 1e-12);
    }
    std::tuple<int, int, int> last{-1, -1, -1};
    for (const Muscle& muscle : fine.muscles) {
        const Spring& spring = fine.springs[muscle.spring];
        EXPECT_NEAR((fine.position[spring.a] - fine.position[spring.b]).norm(), spring.rest_length, 1e-12);
        const std::tuple<int, int, int> place{muscle.actuator, spring.a, spring.b};
        EXPECT_LE(last, place);  // the order that build_model promises
        last = place;
    }
}

/// As much water in as many cells, up to what the finer lattice follows the body's outline better by.
TEST_P(Refinement, KeepsTheWater) {
    const auto water = [](const Model& model) {
        double mass = 0;
        for (int i = 0; i < model.particles(); ++i)
            if (model.is_fluid(i)) mass += 1 / model.inverse_mass[i];
        return mass;
    };
    EXPECT_NEAR(water(both.fine) / water(both.coarse), 1, 0.005);
    EXPECT_GE(both.fine.parameters.substeps, both.coarse.parameters.substeps);
    EXPECT_EQ(both.fine.parameters.fluid_rest_distance, both.coarse.parameters.fluid_rest_distance / 2);
    Eigen::AlignedBox3d coarse, fine;
    for (const FluidBlock* block : {&*both.coarse_scene.fluid, &*both.fine_scene.fluid}) {
        Eigen::AlignedBox3d& box = block == &*both.fine_scene.fluid ? fine : coarse;
        const Eigen::Vector3d half = Eigen::Vector3d::Constant(block->spacing / 2);
        box.extend(block->origin - half);
        box.extend(block->origin + block->spacing * (block->count - Eigen::Vector3i::Ones()).cast<double>() + half);
    }
    EXPECT_LT((coarse.min() - fine.min()).norm() + (coarse.max() - fine.max()).norm(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Creatures, Refinement, testing::Values(1, 2, 3, 4));

TEST(RefinementTest, CountsLateralPlacesFromTheMiddle) {
    const Model fine = both_spacings("open-water/creature-2").fine;
    for (const Muscle& muscle : fine.muscles) {
        const double z = fine.position[fine.springs[muscle.spring].a].z() - 0.8;
        EXPECT_NEAR(muscle.lateral, z / 0.0375, 1e-9);
    }
}

}  // namespace
}  // namespace natator
