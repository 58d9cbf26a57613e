// Our layout of creatures 1 and 2 against the arrays that were given to NVIDIA Flex for the recorded frames.
#include <gtest/gtest.h>

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "natator/model.h"
#include "scene/scene_json.h"
#include "test_name.h"

namespace natator {
namespace {

using nlohmann::json;

/// Coordinates to a thousandth, so that particles can be matched across different orders. The quarter keeps places such
/// as 0.7125 away from where rounding turns.
using Key = std::array<long, 3>;

Key key_of(const Eigen::Vector3d& p) {
    return {std::lround(p.x() * 1000 + 0.25), std::lround(p.y() * 1000 + 0.25), std::lround(p.z() * 1000 + 0.25)};
}

Eigen::Vector3d vector_of(const json& row) {
    return {row[0].get<double>(), row[1].get<double>(), row[2].get<double>()};
}

struct Recorded {
    const char* file;
    const char* scene;
    Gait gait;
};

void PrintTo(const Recorded& recorded, std::ostream* out) {
    test::print_name(recorded.file, out);
}

/// Gait of creature 2 in the recording: a linear from 0.504 to 0.184, phi_i = frac(i 0.431) with i counted from 1.
Gait gait_of_creature_two() {
    Gait gait{1.338, {}, {}, 1};
    for (int i = 0; i < 8; ++i) {
        gait.amplitude.push_back(0.504 + i / 7.0 * (0.184 - 0.504));
        gait.phase.push_back(std::fmod((i + 1) * 0.431, 1.0));
    }
    return gait;
}

class ReferenceModelTest : public testing::TestWithParam<Recorded> {
protected:
    void SetUp() override {
        std::ifstream file(std::string(NATATOR_CONFORMANCE_DIR) + "/one_frame/" + GetParam().file);
        ASSERT_TRUE(file) << GetParam().file;
        const json document = json::parse(file);
        recorded_ = document.is_array() ? document.at(0) : document;
        model_ = build_model(load_scene(GetParam().scene));
        for (const json& row : recorded_.at("rigids").at("rest")) rest_.push_back(vector_of(row));
    }

    json recorded_;
    Model model_;
    std::vector<Eigen::Vector3d> rest_;  ///< of the body's particles, in the recording's order
};

TEST_P(ReferenceModelTest, TheSameParticlesWithTheSameMasses) {
    std::multiset<std::pair<Key, long>> ours, theirs;
    for (int i = 0; i < model_.particles(); ++i) {
        ours.insert({key_of(model_.position[i]), std::lround(model_.inverse_mass[i] * 1e5)});
    }
    const json& positions = recorded_.at("pos");
    for (std::size_t i = 0; i < positions.size(); ++i) {
        theirs.insert({key_of(vector_of(positions[i])), std::lround(recorded_.at("invm")[i].get<double>() * 1e5)});
    }
    EXPECT_EQ(ours, theirs);
}

/// The same springs between the same places with the rest lengths of the gait at time 0, as often.
TEST_P(ReferenceModelTest, TheSameMusclesWithTheSameLengths) {
    State<double> state = initial_state<double>(model_);
    actuate(model_, GetParam().gait, 0, state);
    using Entry = std::tuple<Key, Key, long>;  // front, rear, length in units of 1e-6
    std::multiset<Entry> ours, theirs;
    for (std::size_t i = 0; i < model_.springs.size(); ++i) {
        const Spring& spring = model_.springs[i];
        ours.insert({key_of(model_.position[spring.a]), key_of(model_.position[spring.b]),
                     std::lround(state.spring_rest_length[i] * 1e6)});
    }
    const json& springs = recorded_.at("springs");
    for (std::size_t i = 0; i < springs.at("idx").size(); ++i) {
        const auto rear = springs["idx"][i][0].get<std::size_t>();
        const auto front = springs["idx"][i][1].get<std::size_t>();
        theirs.insert(
            {key_of(rest_.at(front)), key_of(rest_.at(rear)), std::lround(springs.at("l0")[i].get<double>() * 1e6)});
    }
    EXPECT_EQ(ours, theirs);
}

TEST_P(ReferenceModelTest, TheSameClusters) {
    std::set<std::set<Key>> ours, theirs;
    for (const Cluster& cluster : model_.clusters) {
        std::set<Key> places;
        for (const int particle : cluster.particles) places.insert(key_of(model_.position[particle]));
        ours.insert(places);
    }
    for (const json& cluster : recorded_.at("rigids").at("clusters")) {
        std::set<Key> places;
        for (const json& particle : cluster) places.insert(key_of(rest_.at(particle.get<std::size_t>())));
        theirs.insert(places);
    }
    EXPECT_EQ(ours, theirs);
    EXPECT_EQ(ours.size(), recorded_.at("rigids").at("clusters").size());
}

INSTANTIATE_TEST_SUITE_P(
    Recordings, ReferenceModelTest,
    testing::Values(Recorded{"body1_fluid_f0.json", "thesis/creature-1", {1.861, {0.973, 0.690}, {0, 0.648}, 1}},
                    Recorded{
                        "body1_vacuum_f0.json", "thesis/creature-1-vacuum", {1.861, {0.973, 0.690}, {0, 0.648}, 1}},
                    Recorded{"body2_vacuum_f0.json", "thesis/creature-2-vacuum", gait_of_creature_two()}));

}  // namespace
}  // namespace natator
