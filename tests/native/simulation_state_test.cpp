// A simulation's whole moment, saved and gone on from.
#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "coarse_lake.h"
#include "lattice_company.h"
#include "natator/error.h"
#include "natator/load_scene.h"
#include "natator/measure.h"
#include "natator/simulation.h"
#include "refusal_of.h"
#include "scene/scene_json.h"
#include "small_pair.h"

namespace natator::saving {
namespace {

using nlohmann::json;

const Gait swimming{1.861, {0.973, 0.690}, {0, 0.648}, 1};
const json hardly_settled{{"settling", {{"updates", 2}}}};

struct Swim {
    std::string name, scene;
    json overrides;
};

std::ostream& operator<<(std::ostream& out, const Swim& swim) {
    return out << swim.name;
}

class SavedSwim : public testing::TestWithParam<Swim> {};

/// A gait that beats all of a scene's actuators.
Gait beat(int actuators) {
    Gait gait = resting_gait(actuators);
    gait.frequency = 2;
    for (int i = 0; i < actuators; ++i) gait.amplitude[i] = 0.8, gait.phase[i] = 0.3 * i / actuators;
    return gait;
}

/// All that a simulation tells of itself.
template <class Real>
std::vector<double> told(Simulation<Real>& simulation) {
    std::vector<double> all{simulation.time(), simulation.distance(), simulation.muscle_work(),
                            static_cast<double>(simulation.frames())};
    for (const Real density : simulation.densities()) all.push_back(density);
    for (int k = 0; k < simulation.model().swimmers(); ++k) {
        all.push_back(simulation.distance(k));
        all.push_back(simulation.muscle_work(k));
        all.push_back(simulation.gait(k).frequency);
        for (const double value : simulation.driven(k)) all.push_back(value);
    }
    for (const double value : simulation.state().origin) all.push_back(value);
    if (simulation.model().is_fluid(simulation.model().particles() - 1) || simulation.model().water_box)
        for (const auto& velocity : simulation.water().velocity) all.push_back(velocity.norm());
    return all;
}

template <class Real>
void expect_same(Simulation<Real>& one, Simulation<Real>& other) {
    EXPECT_EQ(state_hash(one.state()), state_hash(other.state()));
    EXPECT_EQ(told(one), told(other));
}

template <class Real>
void expect_to_go_on(const Swim& swim) {
    const SimulationSetup setup{swim.scene, swim.overrides.dump()};
    Simulation<Real> first(setup), second(setup);
    const auto actuators = [&](int swimmer) { return first.model().actuators_of(swimmer); };
    const int swimmers = first.model().swimmers();
    for (int k = 0; k < swimmers; ++k) first.set_gait(beat(actuators(k)), k);
    for (int frame = 0; frame < 5; ++frame) {
        for (int k = 0; frame == 4 && k < swimmers; ++k)
            first.drive(std::vector<double>(actuators(k), 0.3 - 0.2 * k), k);
        ASSERT_TRUE(first.step());
    }
    const std::string saved = first.save();
    EXPECT_EQ(saved.size() % 8, 0u);
    EXPECT_TRUE(second.restore(saved));
    expect_same(first, second);
    EXPECT_EQ(first.save(), saved);
    EXPECT_EQ(second.save(), saved);
    for (int frame = 0; frame < 6; ++frame) {
        ASSERT_EQ(first.step(), second.step());
        ASSERT_EQ(state_hash(first.state()), state_hash(second.state())) << frame;
    }
    expect_same(first, second);
    const std::string later = first.save();
    EXPECT_EQ(later, second.save());
    EXPECT_NE(later, saved);
    // Back, by the one that has gone on; a new start, too, is as it would have been.
    EXPECT_FALSE(first.restore(saved));
    EXPECT_EQ(first.save(), saved);
    for (int frame = 0; frame < 6; ++frame) ASSERT_TRUE(first.step());
    EXPECT_EQ(first.save(), later);
    first.reset();
    Simulation<Real> anew(setup);
    for (int k = 0; k < swimmers; ++k) anew.set_gait(beat(actuators(k)), k);
    ASSERT_EQ(first.step(), anew.step());
    expect_same(first, anew);
}

TEST_P(SavedSwim, GoesOnWithTheSameBits) {
    expect_to_go_on<float>(GetParam());
}

json merged(json all, const json& more) {
    all.merge_patch(more);
    return all;
}

INSTANTIATE_TEST_SUITE_P(
    Schemes, SavedSwim,
    testing::Values(
        Swim{"flex", "bench/small-tank", merged(hardly_settled, {{"scheme", "flex"}})},
        Swim{"conserving", "bench/small-tank", merged(hardly_settled, {{"scheme", "conserving"}})},
        Swim{"vacuum", "thesis/creature-1-vacuum", json::object()},
        Swim{"effects", "bench/small-tank",
             merged(hardly_settled,
                    {{"scheme", "conserving"}, {"solver", {{"cohesion", 0.02}, {"surfaceTension", 0.1}}}})},
        Swim{"lattice", "lake/creature-2", test::coarse_lake},
        Swim{"lattice_in_a_moving_tank", "lake/creature-2",
             merged(test::coarse_lake, {{"movingTank", {{"along", "x"}, {"step", 0.075}, {"current", {-6, 0, 0}}}}})},
        Swim{"companions", "company/school", hardly_settled},
        Swim{"companions_in_flex", "bench/small-tank", test::small_pair},
        Swim{"companions_in_lattice", "plane/pair", test::pair_json(json::object())},
        Swim{"goal_in_a_current", "goals/hold", merged(hardly_settled, {{"movingTank", {{"step", 0.002}}}})},
        Swim{"goal", "goals/reach", hardly_settled}, Swim{"periodic", "open-water/periodic", hardly_settled}),
    [](const auto& swim) { return swim.param.name; });

/// That a step of the tank lies between, and one after, is worth saying.
TEST(SavedSimulation, ATankHasMovedInTheseTests) {
    const json overrides = merged(hardly_settled, {{"movingTank", {{"step", 0.002}, {"current", {0, 0, 0}}}}});
    Simulation<float> simulation({"goals/hold", overrides.dump(), beat(8)});
    while (simulation.frames() < 11) ASSERT_TRUE(simulation.step());
    EXPECT_NE(simulation.state().origin.norm(), 0);
}

TEST(SavedSimulation, GoesOnWithTheSameBitsInDoublePrecision) {
    for (const char* scheme : {"flex", "conserving"})
        expect_to_go_on<double>({scheme, "bench/small-tank", merged(hardly_settled, {{"scheme", scheme}})});
    expect_to_go_on<double>({"lattice", "lake/creature-2", test::coarse_lake});
}

TEST(SavedSimulation, TheStartIsOneToGoBackTo) {
    Simulation<float> first({"bench/small-tank", hardly_settled.dump(), swimming}),
        second({"bench/small-tank", hardly_settled.dump(), swimming});
    second.step();
    EXPECT_FALSE(second.restore(first.save()));
    expect_same(first, second);
    first.step();
    second.step();
    expect_same(first, second);
}

TEST(SavedSimulation, BringsItsOverridesStartGaitAndSteering) {
    Simulation<float> first({"bench/small-tank", hardly_settled.dump(), swimming, 3}),
        second(SimulationSetup{"bench/small-tank", hardly_settled.dump()});
    first.step();
    EXPECT_FALSE(first.merge_overrides(R"({"solver": {"dynamicFriction": 0.31}})"));
    first.steer({{0.5, 1}, {0.25, -0.125}});
    for (int frame = 0; frame < 3; ++frame) first.step();
    EXPECT_TRUE(second.restore(first.save()));
    EXPECT_EQ(second.gait(), swimming);
    EXPECT_EQ(second.setup().start, 3);
    EXPECT_EQ(second.steering().offset, first.steering().offset);
    EXPECT_EQ(second.model().parameters.dynamic_friction, 0.31);
    for (int frame = 0; frame < 5; ++frame) first.step(), second.step();
    expect_same(first, second);
    first.reset();
    second.reset();
    expect_same(first, second);
}

TEST(SavedSimulation, RefusesInOneLineAndChangesNothing) {
    Simulation<float> simulation({"bench/small-tank", hardly_settled.dump(), swimming});
    simulation.step();
    const std::string saved = simulation.save();
    const auto refusal = [&](const std::string& bytes) {
        const std::string said = test::refusal_of([&] { simulation.restore(bytes); });
        EXPECT_EQ(simulation.save(), saved);
        EXPECT_EQ(said.find('\n'), std::string::npos);
        return said;
    };
    const auto of = [](const char* scene, json overrides) {
        overrides.merge_patch(hardly_settled);
        return Simulation<float>(SimulationSetup{scene, overrides.dump()}).save();
    };
    EXPECT_EQ(refusal(""), "state: is no saved state; must be a STAT body, as save sends it");
    EXPECT_EQ(refusal("natator-sim"), "state: is no saved state; must be a STAT body, as save sends it");
    EXPECT_EQ(refusal(saved.substr(0, 20)), "state: is cut off: has 20 bytes");
    EXPECT_EQ(refusal(saved.substr(0, 100)), "state: is cut off: has 100 bytes of " + std::to_string(saved.size()));
    EXPECT_EQ(refusal(saved + "more"), "state: is damaged: its checksum is another");
    for (const std::size_t at : {std::size_t{30}, saved.size() / 2, saved.size() - 1}) {
        std::string damaged = saved;
        damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
        EXPECT_EQ(refusal(damaged), "state: is damaged: its checksum is another") << at;
    }
    EXPECT_EQ(refusal(of("thesis/creature-1", {{"scheme", "flex"}})),
              "state: of scene \"thesis/creature-1\"; must be of the scene that runs, \"bench/small-tank\", with the "
              "same content");
    EXPECT_EQ(refusal(of("bench/small-tank", {{"scheme", "conserving"}})),
              "state: of scheme conserving; must be that which runs, flex");
    Simulation<double> doubles(SimulationSetup{"bench/small-tank", hardly_settled.dump()});
    EXPECT_EQ(refusal(doubles.save()), "state: in precision double; must be that which runs, float");
    Scene made = load_scene("bench/small-tank", hardly_settled);
    made.planes[0].offset -= 1e-3;
    EXPECT_NE(refusal(Simulation<float>(made).save()).find("with the same content"), std::string::npos);
}

TEST(SavedSimulation, AnUnstableOneIsNotSavedButCanGoBack) {
    json overrides = hardly_settled;
    Simulation<float> simulation({"bench/small-tank", overrides.dump(), swimming});
    simulation.step();
    const std::string saved = simulation.save();
    simulation.merge_overrides(R"({"solver": {"relaxationMode": "global"}})");
    while (simulation.step() && simulation.frames() < 200) continue;
    ASSERT_TRUE(simulation.instability());
    EXPECT_EQ(test::refusal_of([&] { simulation.save(); }),
              "state: the simulation is unstable; must be saved before that");
    EXPECT_TRUE(simulation.restore(saved));
    EXPECT_FALSE(simulation.instability());
    EXPECT_EQ(simulation.save(), saved);
}

}  // namespace
}  // namespace natator::saving
