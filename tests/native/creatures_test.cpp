// The four creatures of the thesis (2.7): counts, and that each fits its tank.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "natator/error.h"
#include "natator/model.h"
#include "scene/scene_json.h"
#include "test_name.h"

namespace natator {
namespace {

struct Expected {
    const char* scene;
    std::size_t clusters;
    int actuators;
};

void PrintTo(const Expected& expected, std::ostream* out) {
    test::print_name(expected.scene, out);
}

class CreatureTest : public testing::TestWithParam<Expected> {};

TEST_P(CreatureTest, HasTheClustersAndActuatorsOfTheThesis) {
    const Model model = build_model(load_scene(GetParam().scene));
    EXPECT_EQ(model.clusters.size(), GetParam().clusters);
    EXPECT_EQ(model.actuators, GetParam().actuators);
    EXPECT_GE(model.body.slices.size(), 16u);
    EXPECT_LE(model.body.slices.size(), 20u);
}

/// Muscles come in mirrored pairs, so a gait bends the body as far to the left as to the right.
TEST_P(CreatureTest, EveryActuatorHasAsMuchMuscleLeftAsRight) {
    const Model model = build_model(load_scene(GetParam().scene));
    std::vector<double> sum(static_cast<std::size_t>(model.actuators)), size(sum.size());
    for (const Muscle& muscle : model.muscles) {
        sum[muscle.actuator] += muscle.lateral;
        size[muscle.actuator] += std::abs(muscle.lateral);
    }
    for (std::size_t i = 0; i < sum.size(); ++i) {
        EXPECT_NEAR(sum[i], 0, 1e-12);
        EXPECT_GE(size[i], 8) << "actuator " << i;
    }
}

/// The early stop at planes must not end a run before it began.
TEST_P(CreatureTest, StartsClearOfAllPlanes) {
    const Model model = build_model(load_scene(GetParam().scene));
    for (const int particle : model.body.particles) {
        for (const Plane& plane : model.planes) EXPECT_GT(plane.distance(model.position[particle]), 0.2);
    }
}

INSTANTIATE_TEST_SUITE_P(Thesis, CreatureTest,
                         testing::Values(Expected{"thesis/creature-1", 4, 2}, Expected{"thesis/creature-2", 10, 8},
                                         Expected{"thesis/creature-3", 7, 5}, Expected{"thesis/creature-4", 5, 3}));

/// "Most clusters in the tail": five of creature 3's seven clusters lie wholly in the rear half.
TEST(CreatureTest, CreatureThreeHasMostClustersInItsTail) {
    const Scene scene = load_scene("thesis/creature-3");
    const auto half = static_cast<int>(scene.creature->slices.size()) / 2;
    const auto& joints = scene.creature->joints;
    EXPECT_GE(std::count_if(joints.begin(), joints.end(), [&](int joint) { return joint >= half - 1; }), 5);
}

/// Its muscles run across the joint, from the first slice to the last, outside the lateral middle.
TEST(CreatureTest, TwoClustersHaveOneActuatorAcrossTheirJoint) {
    const Scene scene = load_scene("thesis/two-clusters");
    const Model model = build_model(scene);
    EXPECT_EQ(model.clusters.size(), 2u);
    EXPECT_EQ(model.actuators, 1);
    EXPECT_EQ(model.muscles.size(), 5u * 2 * 4);
    for (const Spring& spring : model.springs) EXPECT_NEAR(spring.rest_length, 16 * 0.075, 1e-12);
    EXPECT_EQ(build_model(load_scene("thesis/two-clusters-vacuum")).particles(), 170);
}

/// Left out, the joints are what muscles run between; out of order or outside the body they are refused.
TEST(CreatureTest, MuscleSlicesReplaceTheJoints) {
    const auto muscles = [](const char* slices) {
        return nlohmann::json{{"creature", {{"muscleSlices", nlohmann::json::parse(slices)}}}};
    };
    EXPECT_EQ(build_model(load_scene("thesis/creature-1", muscles("[0, 4, 8, 16]"))).actuators, 3);
    EXPECT_EQ(build_model(load_scene("thesis/creature-1", muscles("[4, 8, 12]"))).springs.size(),
              build_model(load_scene("thesis/creature-1")).springs.size());
    for (const char* bad : {"[4, 4]", "[8, 4]", "[0, 17]", "[-1, 3]", "3"}) {
        EXPECT_THROW(load_scene("thesis/creature-1", muscles(bad)), InputError) << bad;
    }
}

}  // namespace
}  // namespace natator
