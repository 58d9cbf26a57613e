// What a scene takes is known before it runs, and what is beyond the limits is refused in one line.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numeric>

#include "bare_particles.h"
#include "natator/cost.h"
#include "natator/error.h"
#include "natator/evaluate.h"
#include "natator/limits.h"
#include "natator/model.h"
#include "natator/simulation.h"
#include "refusal_of.h"
#include "scene/scene_json.h"
#include "test_name.h"

namespace natator {
namespace {

Scene with(const std::string& name, const std::string& overrides) {
    return load_scene(name, nlohmann::json::parse(overrides));
}

/// The line that an evaluation of the scene is refused with; empty if it is not.
std::string refusal(const Scene& scene) {
    return test::refusal_of([&] { check_evaluation_cost(scene, build_model(scene)); });
}

/// Sets a variable of the environment for as long as it lives.
class Variable {
public:
    Variable(const char* name, const char* value) : name_(name) { setenv(name, value, 1); }
    ~Variable() { unsetenv(name_); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

private:
    const char* name_;
};

TEST(CostTest, EveryNamedSceneIsWithinTheLimits) {
    for (const std::string& name : scene_names()) EXPECT_EQ(refusal(load_scene(name)), "") << name;
}

/// 4 s of ten million particles, or an hour of the thesis' tank, are meant to be computed.
TEST(CostTest, LongRunsAreWithinTheLimits) {
    EXPECT_EQ(refusal(with("thesis/creature-1", R"({"duration":3600})")), "");
    const Model tank = build_model(load_scene("thesis/tank"));
    const double of_particle = cost_of(tank).per_substep / tank.particles();
    EXPECT_LT(1e7 * of_particle * 960, limits::work);
    const double of_program = cost_of(test::bare_model(Scheme::flex, test::Points{{1, 1, 1}}, test::fluid_phase)).bytes;
    EXPECT_LT(1e7 * (cost_of(tank).bytes - of_program) / tank.particles() + of_program, 20e9);
}

/// Each cell counts, with a body and without; solids in it count with all their iterations.
TEST(CostTest, CellsOfALatticeCount) {
    const Scene lake = load_scene("lake/creature-2"), water = load_scene("lake/water");
    const Cost swum = cost_of(build_model(lake)), empty = cost_of(build_model(water));
    EXPECT_EQ(empty.cells, 120 * 48 * 48);
    EXPECT_EQ(swum.cells, empty.cells);
    const double of_one_thread = cost_of(build_model(water), {.several_threads = false}).bytes;
    EXPECT_GT(of_one_thread, 36e6);  // measured, less what a body and the program take
    EXPECT_LT(of_one_thread, 1.1 * 36e6);
    EXPECT_GT(empty.bytes, 55e6);
    EXPECT_LT(empty.bytes, 1.4 * 55e6);
    EXPECT_GT(swum.bytes, empty.bytes);
    EXPECT_GT(empty.per_substep, empty.cells);
    EXPECT_GT(swum.per_substep, empty.per_substep);
    const Cost doubled = cost_of(build_model(with("lake/creature-2", R"({"solver":{"solidIterations":8}})")));
    EXPECT_GT(doubled.per_substep, swum.per_substep);
    const std::string refused = refusal(with("lake/water", R"({"fluid":{"count":[10000,6400,6400]},"planes":[]})"));
    EXPECT_NE(refused.find("in 4.1e+11 cells of water need about "), std::string::npos) << refused;
}

/// The estimate is never below what the solver finds, and not absurdly above it.
TEST(CostTest, NeighboursAreEstimatedFromAbove) {
    for (const char* name : {"thesis/creature-1", "thesis/creature-4", "thesis/tank", "bench/small-tank"}) {
        for (const Scheme scheme : {Scheme::flex, Scheme::conserving}) {
            Scene scene = load_scene(name);
            scene.scheme = scheme;
            const Model model = build_model(scene);
            Solver<float> solver(model);
            State<float> state = initial_state<float>(model);
            for (int frame = 0; frame < 2; ++frame) ASSERT_FALSE(solver.frame(state, resting_gait(model.actuators)));
            const std::vector<int> counts = solver.neighbour_counts();
            const double found = std::accumulate(counts.begin(), counts.end(), 0.0);
            EXPECT_GE(cost_of(model).neighbours, found) << name;
            EXPECT_LE(cost_of(model).neighbours, 7 * found) << name;
        }
    }
}

/// Particles in one place, or so far apart that the grid puts them into a few cells, are all each other's candidates.
TEST(CostTest, CrowdsAndFarFlungParticlesAreSeen) {
    const test::Points crowd(1000, {1, 1, 1});
    EXPECT_GE(cost_of(test::bare_model(Scheme::flex, crowd, test::fluid_phase)).candidates, 1e6);
    test::Points far = test::lattice(10, 10, 10, 0.1);
    EXPECT_LT(cost_of(test::bare_model(Scheme::flex, far, test::fluid_phase)).candidates, 2e5);
    far.push_back({1e30, 1e30, 1e30});
    EXPECT_GE(cost_of(test::bare_model(Scheme::flex, far, test::fluid_phase)).candidates, 1e6);
}

struct Dear {
    const char* overrides;  ///< merged into thesis/creature-1
    const char* expected;   ///< must be in the message
};

void PrintTo(const Dear& dear, std::ostream* out) {
    test::print_name(dear.overrides, out);
}

const Dear dear_scenes[] = {
    {R"({"duration":160000})", "4 iterations are about"},
    {R"({"solver":{"substeps":1000,"numIterations":1000}})", "1000 iterations are about"},
    {R"({"settling":{"updates":1000000,"substeps":1000}})", "in 1e+09 substeps"},
    {R"({"duration":0.1,"fluid":{"count":[200,100,100],"spacing":0.0001},"creature":null,"planes":[]})", "neighbours"},
    {R"({"fluid":{"count":[100,100,100]},"creature":{"rearCentre":[9000,9000,9000]},"planes":[]})", "neighbours"},
    {R"({"solver":{"radius":900,"solidRestDistance":1,"fluidRestDistance":50,"maxNeighborsPerParticle":4096},)"
     R"("fluid":{"count":[100,100,100]},"planes":[]})",
     "neighbours"},
};

class DearSceneTest : public testing::TestWithParam<Dear> {};

TEST_P(DearSceneTest, IsRefusedInOneLineBeforeItRuns) {
    const std::string message = refusal(with("thesis/creature-1", GetParam().overrides));
    EXPECT_EQ(message.find("scene \"thesis/creature-1\": "), 0u) << message;
    EXPECT_NE(message.find(GetParam().expected), std::string::npos) << message;
    EXPECT_NE(message.find("must be at most "), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(All, DearSceneTest, testing::ValuesIn(dear_scenes));

TEST(CostTest, AnEvaluationThatCostsTooMuchDoesNotBegin) {
    const Scene scene = with("thesis/creature-1-vacuum", R"({"settling":{"updates":1000000,"substeps":1000}})");
    EXPECT_THROW(evaluate(scene, resting_gait(2)), InputError);
    SimulationSetup setup;
    setup.scene = "thesis/creature-1-vacuum";
    setup.overrides = R"({"settling":{"updates":1000000,"substeps":1000}})";
    EXPECT_THROW(Simulation<float>{setup}, InputError);
}

/// Whatever else it costs: nothing moves there but a single particle.
TEST(CostTest, MoreTimeStepsThanTenMillionAreRefusedOfWhateverRuns) {
    const Variable work("NATATOR_MOST_WORK", "1e30");
    const std::string limit = "must be at most 10 million time steps of timeStep = ";
    const char* const small = R"({"fluid":{"count":[1,1,1]},"settling":{"updates":0},"timeStep":0.01})";
    Scene scene = with("thesis/tank", small);
    scene.duration = 99'999.9;
    EXPECT_EQ(refusal(scene), "");
    for (const double duration : {100'000.1, 1e6, 1e300}) {
        scene.duration = duration;
        EXPECT_NE(refusal(scene).find(": duration = "), std::string::npos) << refusal(scene);
        EXPECT_NE(refusal(scene).find(limit + "0.01"), std::string::npos) << refusal(scene);
    }
    SimulationSetup setup{.scene = "thesis/tank", .overrides = small, .until = 1e6};
    const std::string refused = test::refusal_of([&] { Simulation<float>{setup}; });
    EXPECT_EQ(refused, "scene \"thesis/tank\": until = 1e+06: " + limit + "0.01");
    setup.until = 1000;
    Simulation<float> live(setup);
    EXPECT_NE(test::refusal_of([&] { live.merge_overrides(R"({"timeStep":1e-5})"); }).find(limit + "1e-05"),
              std::string::npos);
    setup.until = 1e6;
    EXPECT_THROW(live.load(setup), InputError);
    EXPECT_TRUE(live.step());
}

/// As an evaluation of that duration, where 100 frames would not cost too much.
TEST(CostTest, AStreamWithAnEndMayCostWhatAnEvaluationMay) {
    EXPECT_NE(refusal(with("thesis/creature-1", R"({"duration":1e5})")).find("pair visits"), std::string::npos);
    const SimulationSetup setup{.scene = "thesis/creature-1", .until = 1e5};
    EXPECT_NE(test::refusal_of([&] { Simulation<float>{setup}; }).find("pair visits"), std::string::npos);
}

TEST(CostTest, TheEnvironmentReplacesTheLimits) {
    const Scene scene = load_scene("thesis/creature-1");
    {
        const Variable work("NATATOR_MOST_WORK", "1e6");
        EXPECT_NE(refusal(scene).find("must be at most 1e+06 (NATATOR_MOST_WORK)"), std::string::npos)
            << refusal(scene);
    }
    {
        const Variable memory("NATATOR_MOST_MEMORY", "0.001");
        EXPECT_NE(refusal(scene).find("must be at most 0.001 GiB (NATATOR_MOST_MEMORY)"), std::string::npos)
            << refusal(scene);
    }
    {
        const Variable work("NATATOR_MOST_WORK", "1e15");
        EXPECT_EQ(refusal(with("thesis/creature-1", R"({"duration":160000})")), "");
    }
    for (const char* name : {"NATATOR_MOST_WORK", "NATATOR_MOST_MEMORY"})
        for (const std::string value :
             {"much", "-1", "0", "nan", "inf", "1e6x", "0x1p60", " 1e15", "1e15 ", "+-1", "1e999"}) {
            const Variable most(name, value.c_str());
            EXPECT_EQ(refusal(scene),
                      std::string("environment: ") + name + " = \"" + value + "\": must be a decimal number above 0");
        }
}

}  // namespace
}  // namespace natator
