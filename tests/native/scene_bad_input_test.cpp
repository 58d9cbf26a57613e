// Every kind of unusable scene is refused with one line that names the field and says what is allowed.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "natator/error.h"
#include "refusal.h"
#include "scene/scene_json.h"
#include "test_name.h"

namespace natator {
namespace {

const BadInput bad_scenes[] = {
    // Unknown keys name the nearest one, or all.
    {R"({"solver":{"raduis":0.15}})", "solver.raduis", "did you mean radius?"},
    {R"({"solver":{"num_iterations":4}})", "solver.num_iterations", "did you mean numIterations?"},
    {R"({"solver":{"zzzzzz":0}})", "solver.zzzzzz", "allowed: wind, drag"},
    {R"({"durations":4})", "durations", "did you mean duration?"},
    {R"({"base":"thesis/tank"})", "overrides.base = ", "left out: the scene is chosen before it is changed"},
    {R"({"bsae":"thesis/tank"})", "bsae", "did you mean base?"},
    {R"({"fluid":{"sapcing":1}})", "fluid.sapcing", "did you mean spacing?"},
    {R"({"fluid":{"mass":{"botom":1}}})", "fluid.mass.botom", "did you mean bottom?"},
    {R"({"creature":{"jointz":[4,8]}})", "creature.jointz", "did you mean joints?"},
    {R"({"creature":{"slices":[{"height":5,"width":3,"cuont":2}]}})", "creature.slices[0].cuont",
     "did you mean count?"},
    {R"({"creature":{"profile":{"length":1,"foo":1}}})", "profile.foo", "allowed: length, height, width, fin, joints"},
    {R"({"foo":1})", "foo", "allowed: "},
    {R"({"settling":{"steps":1}})", "settling.steps", "allowed: updates, timeStep, substeps"},
    {R"({"stopping":{"planecontact":true}})", "stopping.planecontact", "did you mean planeContact?"},
    // Wrong types.
    {R"({"duration":"4"})", "duration = \"4\"", "a number"},
    {R"({"description":4})", "description = 4", "a string"},
    {R"({"solver":[]})", "solver = []", "an object"},
    {R"({"solver":{"radius":true}})", "solver.radius = true", "a number"},
    {R"({"solver":{"substeps":4.5}})", "solver.substeps = 4.5", "a whole number in [1, 1000]"},
    {R"({"solver":{"substeps":99999999999999}})", "solver.substeps = 99999999999999", "[1, 1000]"},
    {R"({"solver":{"gravity":-10}})", "solver.gravity = -10", "an array of 3 numbers"},
    {R"({"solver":{"gravity":[0,-10]}})", "solver.gravity = [0,-10]", "an array of 3 numbers"},
    {R"({"solver":{"gravity":[0,"x",0]}})", "solver.gravity[1] = \"x\"", "a number"},
    {R"({"solver":{"relaxationMode":"Local"}})", "solver.relaxationMode = \"Local\"", R"("local" or "global")"},
    {R"({"solver":{"relaxationMode":1}})", "solver.relaxationMode = 1", R"("local" or "global")"},
    {R"({"planes":{}})", "planes = {}", "an array"},
    {R"({"planes":[[0,1,0]]})", "planes[0] = [0,1,0]", "4 numbers"},
    {R"({"fluid":5})", "fluid = 5", "an object"},
    {R"({"creature":"creature-1"})", "creature = \"creature-1\"", "an object, such as {\"name\": \"creature-1\"}"},
    {R"({"stopping":{"planeContact":1}})", "stopping.planeContact = 1", "true or false"},
    // Out of range.
    {R"({"duration":0})", "duration = 0", "(0, 1e+06] (s)"},
    {R"({"duration":0.001})", "duration = 0.001", "at least one timeStep"},
    {R"({"duration":1000000,"timeStep":0.000001})", "duration = 1000000", "10 million time steps"},
    {R"({"timeStep":-0.1})", "timeStep = -0.1", "[1e-06, 1] (s)"},
    {R"({"solver":{"kernelSupport":1.5}})", "solver.kernelSupport = 1.5", "[2, 4] (rest distances of the fluid)"},
    {R"({"solver":{"modifiedPressure":1}})", "solver.modifiedPressure = 1", "true or false"},
    {R"({"scheme":"conserving","planes":[[0,1,0,0]],"solver":{"modifiedPressure":true}})",
     "solver.modifiedPressure = true", "must be false here: it needs a tank with one floor"},
    {R"({"solver":{"kinematicViscosity":-1}})", "solver.kinematicViscosity = -1", "[0, 1000] (length^2/s)"},
    {R"({"scheme":"conserving","solver":{"kinematicViscosity":0.3}})", "solver.kinematicViscosity = 0.3",
     "at most 0.24 (0.1 fluidRestDistance^2 / longest substep, settling included)"},
    {R"({"scheme":"conserving","planes":[[0,1,0,0],[0.6,0.8,0,0]]})", "planes[1] = [0.6,0.8,0.0,0.0]",
     "at a right angle to planes[0] or facing it"},
    {R"({"solver":{"radius":0}})", "solver.radius = 0", "(0, 1000]"},
    {R"({"solver":{"radius":1e300}})", "solver.radius = 1e+300", "(0, 1000]"},
    {R"({"solver":{"numIterations":0}})", "solver.numIterations = 0", "[1, 1000]"},
    {R"({"solver":{"dynamicFriction":-0.2}})", "solver.dynamicFriction = -0.2", "[0, 100]"},
    {R"({"solver":{"restitution":1.01}})", "solver.restitution = 1.01", "[0, 1]"},
    {R"({"solver":{"adhesion":-1}})", "solver.adhesion = -1", "[0, 10000] (length/s^2)"},
    {R"({"solver":{"sleepThreshold":-0.1}})", "solver.sleepThreshold = -0.1", "[0, 1000] (length/s)"},
    {R"({"solver":{"shockPropagation":-1}})", "solver.shockPropagation = -1", "[0, 1000] (1/length)"},
    {R"({"solver":{"dissipation":-1}})", "solver.dissipation = -1", "[0, 1000] (1/s)"},
    {R"({"solver":{"cohesion":-0.025}})", "solver.cohesion = -0.025", "[0, 1000]"},
    {R"({"solver":{"surfaceTension":-1}})", "solver.surfaceTension = -1", "[0, 10000] (length/s^2)"},
    {R"({"solver":{"vorticityConfinement":-1}})", "solver.vorticityConfinement = -1", "[0, 1000] (length/s)"},
    {R"({"solver":{"freeSurfaceDrag":-1}})", "solver.freeSurfaceDrag = -1", "[0, 1000] (1/s)"},
    {R"({"solver":{"maxNeighborsPerParticle":0}})", "solver.maxNeighborsPerParticle = 0", "[1, 4096]"},
    {R"({"solver":{"solidRestDistance":0.16}})", "solver.solidRestDistance = 0.16", "at most radius = 0.15"},
    {R"({"solver":{"fluidRestDistance":0.15}})", "solver.fluidRestDistance = 0.15", "less than radius = 0.15"},
    {R"({"solver":{"radius":1000}})", "solver.fluidRestDistance = 0.1", "at least radius / 20, radius = 1000.0"},
    {R"({"solver":{"fluidRestDistance":1e-10}})", "solver.fluidRestDistance = 1e-10",
     "at least radius / 20, radius = 0.15"},
    {R"({"solver":{"relaxationFactor":-0.1}})", "solver.relaxationFactor = -0.1", "[0, 10]"},
    {R"({"planes":[[0,2,0,0]]})", "planes[0][1] = 2", "[-1, 1]"},
    {R"({"planes":[[0.5,0.5,0,0]]})", "planes[0] = [0.5,0.5,0.0,0.0]", "of length 1"},
    {R"({"fluid":{"count":[50,0,17]}})", "fluid.count[1] = 0", "[1, 10000]"},
    {R"({"fluid":{"mass":{"bottom":-2}}})", "fluid.mass.bottom = -2", "[1e-06, 1e+06]"},
    {R"({"fluid":{"mass":{"top":0}}})", "fluid.mass.top = 0", "[1e-06, 1e+06]"},
    {R"({"fluid":{"mass":{"gradient":"linear"}}})", "fluid.mass.gradient", "\"mass-linear\" or"},
    {R"({"creature":{"particleMass":-1}})", "creature.particleMass = -1", "[1e-06, 1e+06]"},
    {R"({"creature":{"clusterStiffness":1.5}})", "creature.clusterStiffness = 1.5", "[0, 1]"},
    {R"({"creature":{"springsPerParticle":0}})", "creature.springsPerParticle = 0", "[1, 64]"},
    {R"({"creature":{"slices":[]}})", "creature.slices = []", "at least one slice"},
    {R"({"creature":{"slices":[{"height":5}],"joints":[]}})", "creature.slices[0].width", "missing"},
    {R"({"creature":{"slices":[{"height":5,"width":3}]}})", "creature.joints", "missing"},
    {R"({"settling":{"updates":-1}})", "settling.updates = -1", "[0, 1e+06]"},
    {R"({"stopping":{"noProgressAfter":-1}})", "stopping.noProgressAfter = -1", "[0, 1e+06] (s)"},
    // Moving tanks and goals.
    {R"({"movingTank":{"step":0}})", "movingTank.step = 0", "[1e-06, 10000] (length)"},
    {R"({"movingTank":{"along":"y"}})", "movingTank.along = \"y\"", "\"x\" or \"xz\""},
    {R"({"movingTank":{"current":[0,0.1,0]}})", "movingTank.current[1] = 0.1", "a current is horizontal"},
    {R"({"goals":{}})", "goals = {}", "an array of at most 16 goals"},
    {R"({"goals":[{"measure":"fly"}]})", "goals[0].measure = \"fly\"", "\"distance\" or \"forward\" or \"turn\""},
    {R"({"goals":[{"measure":"turn"}]})", "goals[0].target", "missing"},
    {R"({"goals":[{"measure":"turn","target":3}]})", "goals[0].target = 3", "farther than `within`, 5"},
    {R"({"goals":[{"measure":"reach","target":1}]})", "goals[0].target = 1", "array"},
    {R"({"goals":[{"measure":"hold","target":1}]})", "goals[0].target", "unknown"},
    {R"({"goals":[{"measure":"depth","target":0.3,"within":0}]})", "goals[0].within = 0", "(0, 10000]"},
    // Companions and obstacles.
    {R"({"companions":{}})", "companions = {}", "an array of at most 64 companions"},
    {R"({"companions":[{"creature":{"name":"zebra"}}]})", "companions[0].creature.name", "creature-1, creature-2"},
    {R"({"companions":[{"creature":{"name":"creature-1","spacing":0}}]})", "companions[0].creature.spacing = 0",
     "(0, 1000]"},
    {R"({"companions":[{"creature":{"name":"creature-1","rearCentre":[3,0.6,0.6]},"gait":{"frequency":1,"amplitude":[1],"phase":[0]}}]})",
     "companions[0].gait.amplitude has length 1", "must have length 2"},
    {R"({"companions":[{"creature":{"name":"creature-1","rearCentre":[0.6,0.6,0.6]}}]})",
     "companions[0] overlaps creature", "must be apart"},
    {R"({"companions":[{"creature":{"name":"creature-1","rearCentre":[9,0.6,0.6]}}]})",
     "companions[0].creature.rearCentre", "inside all planes"},
    {R"({"obstacles":[{"shape":"cone"}]})", "obstacles[0].shape = \"cone\"", "\"sphere\" or \"box\" or \"mesh\""},
    {R"({"obstacles":[{"shape":"mesh","centre":[1,1,1]}]})", "obstacles[0].file", "missing"},
    {R"({"obstacles":[{"shape":"mesh","file":"none.obj","centre":[1,1,1]}]})", "obstacles[0].file: \"none.obj\"",
     "no such file"},
    {R"({"obstacles":[{"shape":"mesh","file":"hoop.obj","centre":[1,1,1],"unit":0.01}]})",
     "obstacles[0].file: \"hoop.obj\"", "spacings"},
    {R"({"obstacles":[{"shape":"mesh","file":"hoop.obj","centre":[1,1,1],"joints":[0.5]}]})", "obstacles[0].joints",
     "unknown"},
    {R"({"obstacles":[{"shape":"mesh","file":"hoop.obj","centre":[0.6,0.3,0.6],"unit":0.3}]})",
     "creature overlaps obstacles[0]", "must be apart"},
    {R"({"obstacles":[{"shape":"box","centre":[1,1,1],"radius":1}]})", "obstacles[0].radius", "unknown"},
    {R"({"scheme":"conserving","obstacles":[{"shape":"box","centre":[3,1,1],"size":[0.2,0.2,0.2],"spacing":0.11}]})",
     "obstacles[0].spacing = 0.11", "must be at most 0.09, fluid.spacing"},
    {R"({"scheme":"flex","obstacles":[{"shape":"box","centre":[3,1,1],"size":[0.2,0.2,0.2],"spacing":0.21}]})",
     "obstacles[0].spacing = 0.21", "must be at most 0.18, twice fluid.spacing"},
    {R"({"obstacles":[{"shape":"sphere","centre":[1,1,1]}]})", "obstacles[0].radius", "missing"},
    {R"({"obstacles":[{"shape":"sphere","centre":[0.6,0.6,0.6],"radius":0.2}]})", "creature overlaps obstacles[0]",
     "must be apart"},
    {R"({"obstacles":[{"shape":"sphere","centre":[0,0,0],"radius":900,"spacing":0.01}]})", "particles",
     "at most 16000000"},
    // Joints.
    {R"({"creature":{"joints":[8,4,12]}})", "creature.joints[1] = 4", "[9, 15]"},
    {R"({"creature":{"joints":[4,4,12]}})", "creature.joints[1] = 4", "[5, 15]"},
    {R"({"creature":{"joints":[0,8]}})", "creature.joints[0] = 0", "[1, 15]"},
    {R"({"creature":{"joints":[4,16]}})", "creature.joints[1] = 16", "[5, 15]"},
    {R"({"creature":{"joints":[15,15]}})", "creature.joints[1] = 15", "left out"},
    {R"({"creature":{"muscleSlices":[3]}})", "creature.muscleSlices = [3]", "two slices or more"},
    // What the solver does not do.
    {R"({"scheme":"pbd"})", "scheme = \"pbd\"", "\"flex\""},
    {R"({"solver":{"wind":[0,0,1]}})", "solver.wind = [0,0,1]", "cloth only"},
    {R"({"solver":{"plasticCreep":0.1}})", "solver.plasticCreep = 0.1", "cloth only"},
    // Scenes whose parts do not fit together.
    {R"({"creature":{"rearCentre":[0.45,0.1,0.6]}})", "creature.rearCentre", "outside the tank"},
    {R"({"creature":{"rearCentre":[3.5,0.6,0.6]}})", "beyond planes[3]", "inside all planes"},
    {R"({"fluid":{"origin":[0.05,-0.05,0.05]}})", "fluid.origin", "outside the tank"},
    {R"({"fluid":{"count":[300,300,300]},"planes":[]})", "fluid.count", "at most 16000000"},
    {R"({"fluid":null,"planes":[],"creature":{"slices":[{"height":800,"width":800,"count":3},{"height":800,"width":800}],)"
     R"("joints":[1,2],"springsPerParticle":64}})",
     "40960000 springs", "at most 16000000"},
    {R"({"fluid":{"count":[100,100,100],"spacing":0.001,"clearance":10},"planes":[],)"
     R"("creature":{"slices":[{"height":200,"width":200,"count":3}],"joints":[]}})",
     "fluid.clearance = 10", "lattice points"},
    {R"({"fluid":null,"creature":null})", "0 particles", "a creature or fluid"},
    {R"({"creature":{"slices":[{"height":5,"width":1,"count":17}],"joints":[4,8,12]}})", "creature.joints[0]",
     "actuator 0"},
    {R"({"obstacles":[{"shape":"sphere","centre":[0,0,0],"radius":1},{"shape":"sphere","centre":[0,0,1],"radius":1},)"
     R"({"shape":"sphere","centre":[0,0.0,0],"radius":1.0,"spacing":0.2}]})",
     "obstacles[2] = {", "elsewhere than obstacles[0], whose place and shape it has"},
    {R"({"obstacles":[{"shape":"box","centre":[1,1,1],"size":[1,1,2]},{"shape":"box","centre":[1,1,1],"size":[1,1,2]}]})",
     "obstacles[1] = {", "elsewhere than obstacles[0]"},
    {R"({"obstacles":[{"shape":"mesh","file":"hoop.obj","centre":[3,1,1]},{"shape":"mesh","file":"hoop.obj","centre":[3,1,1]}]})",
     "obstacles[1] = {", "elsewhere than obstacles[0]"},
    // Lengths that a scheme does not tell from none.
    {R"({"planes":[],"fluid":null,"creature":{"spacing":0.0099}})", "creature.spacing = 0.0099",
     "at least 0.01 in scheme flex"},
    {R"({"planes":[],"fluid":null,"companions":[{"creature":{"name":"creature-2","spacing":1e-3,"rearCentre":[5,5,5]}}]})",
     "companions[0].creature.spacing = 0.001", "at least 0.01 in scheme flex"},
    {R"({"scheme":"conserving","fluid":null,"creature":{"spacing":3e-7}})", "creature.spacing = 3e-07",
     "at least 5e-07 beside planes"},
    {R"({"creature":{"name":"zebra"}})", "creature.name", "creature-1, creature-2"},
};

class BadSceneTest : public testing::TestWithParam<BadInput> {};

TEST_P(BadSceneTest, IsRefusedWithOneLineThatNamesTheField) {
    const BadInput& bad = GetParam();
    expect_refused("thesis/creature-1", nlohmann::json::parse(bad.overrides), bad.field, {bad.allowed});
}

INSTANTIATE_TEST_SUITE_P(All, BadSceneTest, testing::ValuesIn(bad_scenes));

/// Where no plane is to be touched, scheme conserving has no least length.
TEST(SceneTest, BodiesMayBeSmallWhereNoLengthIsAbsolute) {
    const auto load = [](const char* overrides) {
        return load_scene("thesis/creature-1", nlohmann::json::parse(overrides));
    };
    EXPECT_NO_THROW(load(R"({"planes":[],"fluid":null,"creature":{"spacing":0.01}})"));
    EXPECT_NO_THROW(load(R"({"scheme":"conserving","fluid":null,"creature":{"spacing":6e-7}})"));
    EXPECT_NO_THROW(load(R"({"scheme":"conserving","planes":[],"fluid":null,"creature":{"spacing":1e-8}})"));
    // What a refined body is built of counts.
    Scene scene = load(R"({"planes":[],"fluid":null,"creature":{"spacing":0.018}})");
    EXPECT_NO_THROW(build_model(scene));
    scene.creature->refinement = 2;
    EXPECT_THROW(build_model(scene), InputError);
}

/// The parameters that act on cloth only may be written out as 0.
TEST(SceneTest, ClothParametersMayBeZero) {
    for (const char* key : {"wind", "drag", "lift", "plasticThreshold", "plasticCreep"}) {
        nlohmann::json overrides;
        overrides["solver"][key] = 0;
        EXPECT_NO_THROW(load_scene("thesis/creature-1", overrides)) << key;
        overrides["solver"][key] = 0.5;
        EXPECT_THROW(load_scene("thesis/creature-1", overrides), InputError) << key;
    }
    EXPECT_NO_THROW(load_scene("thesis/tank", nlohmann::json::parse(R"({"solver":{"wind":[0,0,0]}})")));
}

}  // namespace
}  // namespace natator
