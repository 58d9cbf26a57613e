// Layout of the particles: body, fluid, masses, clusters.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "natator/model.h"
#include "scene/scene_json.h"

namespace natator {
namespace {

Model model_of(const std::string& scene, const char* overrides = "{}") {
    return build_model(load_scene(scene, nlohmann::json::parse(overrides)));
}

int fluid_particles(const Model& model) {
    int count = 0;
    for (int i = 0; i < model.particles(); ++i) count += model.is_fluid(i) ? 1 : 0;
    return count;
}

/// Counted in the recorded runs of NVIDIA Flex: 5660 and 5680 fluid particles beside bodies of 255 and 228.
TEST(ModelTest, ThesisScenesHaveTheMeasuredNumbersOfParticles) {
    const Model one = model_of("thesis/creature-1");
    EXPECT_EQ(one.particles(), 5915);
    EXPECT_EQ(fluid_particles(one), 5660);
    EXPECT_EQ(one.body.particles.size(), 255u);
    const Model two = model_of("thesis/creature-2");
    EXPECT_EQ(two.particles(), 5908);
    EXPECT_EQ(fluid_particles(two), 5680);
    EXPECT_EQ(two.body.particles.size(), 228u);
    EXPECT_EQ(model_of("thesis/tank").particles(), 5950);
    EXPECT_EQ(fluid_particles(model_of("thesis/creature-1-vacuum")), 0);
}

TEST(ModelTest, NoFluidIsCloserToTheBodyThanTheClearanceAndNoneFartherIsMissing) {
    for (const double clearance : {0.0, 0.03, 0.15, 0.4}) {
        nlohmann::json overrides;
        overrides["fluid"]["clearance"] = clearance;
        const Model model = build_model(load_scene("thesis/creature-4", overrides));
        const auto body = static_cast<int>(model.body.particles.size());
        const double* const first = model.position.front().data();
        const auto nearest = [&](const Eigen::Vector3d& point) {  // by bare numbers: many pairs, and no optimization
            const double *p = point.data(), *const end = first + 3 * body;
            double least = 1e18;
            for (const double* at = first; at != end; at += 3) {
                const double x = at[0] - p[0], y = at[1] - p[1], z = at[2] - p[2], squared = x * x + y * y + z * z;
                if (squared < least) least = squared;
            }
            return std::sqrt(least);
        };
        for (int i = body; i < model.particles(); ++i) ASSERT_GE(nearest(model.position[i]), clearance);
        int expected = 0;
        for (int x = 0; x < 50; ++x) {
            for (int y = 0; y < 7; ++y) {
                for (int z = 0; z < 17; ++z) {
                    expected += nearest({0.05 + 0.09 * x, 0.05 + 0.09 * y, 0.05 + 0.09 * z}) >= clearance ? 1 : 0;
                }
            }
        }
        EXPECT_EQ(fluid_particles(model), expected) << clearance;
    }
}

TEST(ModelTest, FluidFillsTheLatticeByXThenYThenZ) {
    const Model model = model_of("thesis/tank");
    EXPECT_TRUE(model.position[0].isApprox(Eigen::Vector3d(0.05, 0.05, 0.05)));
    EXPECT_TRUE(model.position[1].isApprox(Eigen::Vector3d(0.05, 0.05, 0.14)));
    EXPECT_TRUE(model.position[17].isApprox(Eigen::Vector3d(0.05, 0.14, 0.05)));
    EXPECT_TRUE(model.position[119].isApprox(Eigen::Vector3d(0.14, 0.05, 0.05)));
    EXPECT_TRUE(model.position[5949].isApprox(Eigen::Vector3d(4.46, 0.59, 1.49)));
    EXPECT_EQ(model.phase[0], phase::fluid | phase::self_collide);
}

/// Mass of the particles of each of the seven layers, from the recorded scenes.
void expect_layers(const Model& model, const std::vector<double>& inverse_mass) {
    for (int i = 0; i < model.particles(); ++i) {
        const auto layer = static_cast<std::size_t>(std::lround((model.position[i].y() - 0.05) / 0.09));
        ASSERT_NEAR(model.inverse_mass[i], inverse_mass.at(layer), 1e-6) << i;
    }
}

TEST(ModelTest, MassesFollowTheHeight) {
    expect_layers(model_of("thesis/tank"), {0.5, 0.59574467, 0.7368421, 0.9655172, 1.4, 2.5454545, 14});
    expect_layers(model_of("thesis/tank", R"({"fluid":{"mass":{"gradient":"inverse-mass-linear"}}})"),
                  {0.5, 2.75, 5, 7.25, 9.5, 11.75, 14});
    expect_layers(model_of("thesis/tank", R"({"fluid":{"mass":{"gradient":"uniform","bottom":4}}})"),
                  {0.25, 0.25, 0.25, 0.25, 0.25, 0.25, 0.25});
}

TEST(ModelTest, OneLayerOfFluidHasTheBottomMass) {
    const Model model = model_of("thesis/tank", R"({"fluid":{"count":[3,1,3]}})");
    ASSERT_EQ(model.particles(), 9);
    for (const double inverse_mass : model.inverse_mass) EXPECT_EQ(inverse_mass, 0.5);
}

TEST(ModelTest, BodyLiesAlongXWithItsHeadInFrontAndItsRearWhereTheSceneSays) {
    const Model model = model_of("thesis/creature-1");
    ASSERT_EQ(model.body.slices.size(), 17u);
    EXPECT_NEAR(model.body.length, 1.2, 1e-12);
    // Head slice first, at 0.45 + 16 * 0.075; within a slice lowest left particle first, then to the right, then up.
    EXPECT_TRUE(model.position[0].isApprox(Eigen::Vector3d(1.65, 0.45, 0.525)));
    EXPECT_TRUE(model.position[1].isApprox(Eigen::Vector3d(1.65, 0.45, 0.6)));
    EXPECT_TRUE(model.position[3].isApprox(Eigen::Vector3d(1.65, 0.525, 0.525)));
    EXPECT_TRUE(model.position[254].isApprox(Eigen::Vector3d(0.45, 0.75, 0.675)));
    Eigen::Vector3d rear = Eigen::Vector3d::Zero();
    for (const int particle : model.body.slices.back()) rear += model.position[particle] / 15;
    EXPECT_TRUE(rear.isApprox(Eigen::Vector3d(0.45, 0.6, 0.6)));
    for (int i = 0; i < 255; ++i) {
        EXPECT_EQ(model.phase[i], 1u);  // group 1, no self-collision
        EXPECT_EQ(model.inverse_mass[i], 1);
        EXPECT_EQ(model.velocity[i], Eigen::Vector3d::Zero());
    }
}

/// Neighbouring clusters share the joint's slice; offsets are taken from the plain mean.
TEST(ModelTest, ClustersRunFromJointToJointBothIncluded) {
    const Model model = model_of("thesis/creature-1");
    ASSERT_EQ(model.clusters.size(), 4u);
    const int first[] = {0, 60, 120, 180};
    const double centre_x[] = {1.5, 1.2, 0.9, 0.6};
    for (std::size_t c = 0; c < 4; ++c) {
        const Cluster& cluster = model.clusters[c];
        ASSERT_EQ(cluster.particles.size(), 75u);
        for (int i = 0; i < 75; ++i) EXPECT_EQ(cluster.particles[i], first[c] + i);
        EXPECT_TRUE(cluster.centre.isApprox(Eigen::Vector3d(centre_x[c], 0.6, 0.6)));
        EXPECT_TRUE(cluster.rest_offset[0].isApprox(Eigen::Vector3d(0.15, -0.15, -0.075)));
        EXPECT_EQ(cluster.stiffness, 0.2);
    }
    const Model two = model_of("thesis/creature-2");
    ASSERT_EQ(two.clusters.size(), 10u);
    EXPECT_EQ(two.clusters[0].particles.size(), 24u);
    EXPECT_EQ(two.clusters[1].particles.size(), 36u);
    EXPECT_EQ(two.clusters[9].particles.size(), 24u);
}

TEST(ModelTest, ABodyWithoutJointsIsOneCluster) {
    const Model model = model_of(
        "thesis/tank", R"({"creature":{"name":"block","slices":[{"height":2,"width":2,"count":3}],"joints":[]}})");
    EXPECT_EQ(model.clusters.size(), 1u);
    EXPECT_EQ(model.clusters[0].particles.size(), 12u);
    EXPECT_TRUE(model.springs.empty());
}

}  // namespace
}  // namespace natator
