#include "stage_cost.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>
#include <nlohmann/json.hpp>

#include "bench_scenes.h"
#include "machine.h"
#include "natator/error.h"
#include "natator/evaluate.h"
#include "scene/scene_json.h"

namespace natator::bench {
namespace {

/// A feature with what switches it off and on in the thesis tank, as JSON Merge Patches.
struct Feature {
    const char* name;
    const char* stage[2];  ///< where it works: in scheme flex, in scheme conserving; null: not in this scheme or scene
    const char* off;
    const char* on;
};

constexpr const char* vacuum = R"({"fluid":null,"planes":[],"solver":{"gravity":[0,0,0]}})";
constexpr const char* no_creature = R"({"creature":null})";
constexpr const char* as_it_is = "{}";

constexpr std::array features = {
    Feature{"fluid", {"density constraint", "density constraint"}, vacuum, as_it_is},
    Feature{"fluid neighbours", {"fluid neighbours", "fluid neighbours"}, vacuum, as_it_is},
    Feature{"planes", {"planes", "planes"}, vacuum, as_it_is},
    Feature{"contacts", {"contacts", nullptr}, no_creature, as_it_is},
    Feature{"springs", {"springs", "springs"}, no_creature, as_it_is},
    Feature{"clusters", {"shape matching", "shape matching"}, no_creature, as_it_is},
    Feature{"solidPressure", {"density", nullptr}, R"({"solver":{"solidPressure":0}})", as_it_is},
    Feature{"friction", {"planes", "planes"}, R"({"solver":{"dynamicFriction":0,"particleFriction":0}})", as_it_is},
    Feature{"viscosity",
            {"velocities", "viscosity"},
            R"({"solver":{"viscosity":0}})",
            R"({"solver":{"kinematicViscosity":0.002}})"},
    Feature{"damping", {"velocities", "velocities"}, R"({"solver":{"damping":0}})", as_it_is},
    Feature{"maxSpeed", {"velocities", "velocities"}, as_it_is, R"({"solver":{"maxSpeed":100}})"},
    Feature{"cohesion", {"cohesion", "fluid forces"}, as_it_is, R"({"solver":{"cohesion":0.01}})"},
    Feature{"surfaceTension", {"fluid forces", "fluid forces"}, as_it_is, R"({"solver":{"surfaceTension":0.01}})"},
    Feature{
        "vorticityConfinement", {"fluid forces", "fluid forces"}, as_it_is, R"({"solver":{"vorticityConfinement":1}})"},
    Feature{
        "freeSurfaceDrag", {"free-surface drag", "fluid forces"}, as_it_is, R"({"solver":{"freeSurfaceDrag":0.1}})"},
    Feature{"dissipation", {"dissipation", nullptr}, as_it_is, R"({"solver":{"dissipation":0.1}})"},
    Feature{"shockPropagation", {"contacts", nullptr}, as_it_is, R"({"solver":{"shockPropagation":1}})"},
    Feature{"adhesion", {"adhesion", "adhesion"}, as_it_is, R"({"solver":{"adhesion":1}})"},
    Feature{"restitution", {"restitution", "restitution"}, as_it_is, R"({"solver":{"restitution":0.1}})"},
    Feature{"sleepThreshold", {"sleep", "sleep"}, as_it_is, R"({"solver":{"sleepThreshold":1e-6}})"},
};

const Feature& find_feature(const std::string& name) {
    const auto found = std::ranges::find(features, name, &Feature::name);
    if (found != features.end()) return *found;
    throw InputError("unknown feature \"" + name + "\": must be one of " + joined(stage_feature_names(), ", "));
}

constexpr double unmeasured = std::numeric_limits<double>::infinity();

/// One state of a feature, with what was measured so far.
struct Case {
    Row key;
    Scene scene;
    std::string stage;
    long calls = 0;
    double stage_seconds = unmeasured, seconds = unmeasured, unskipped_seconds = unmeasured;
    std::string hash{}, unskipped_hash{};
};

Case make_case(const Feature& feature, Scheme scheme, const std::string& state, bool quick) {
    nlohmann::json overrides = {{"duration", quick ? 2.0 / 60 : 0.25},
                                {"settling", {{"updates", quick ? 1 : 20}}},
                                {"stopping", {{"planeContact", false}, {"noProgressAfter", 0}}}};
    // Merged here without applying: a null is for the scene, which it takes something from.
    overrides.update(nlohmann::json::parse(state == "on" ? feature.on : feature.off), true);
    Scene scene = load_scene("thesis/creature-1", overrides);
    scene.scheme = scheme;
    return {.key = {feature.name, to_string(scheme), state, machine_text()},
            .scene = std::move(scene),
            .stage = feature.stage[scheme == Scheme::conserving]};
}

/// Wall time of an evaluation, s.
double timed(const Case& one, const Execution& execution, std::string& hash) {
    using Clock = std::chrono::steady_clock;
    const Gait gait = one.scene.creature ? thesis_gait(1) : Gait{};
    EvaluationOptions options;
    options.execution = execution;
    const auto start = Clock::now();
    const Evaluation result = evaluate(one.scene, gait, options);
    hash = hash_text(result.hash);
    return std::chrono::duration<double>(Clock::now() - start).count();
}

void measure(Case& one, bool skipped_only) {
    StageProfile profile;
    one.seconds = std::min(one.seconds, timed(one, {.profile = &profile}, one.hash));
    if (!skipped_only)
        one.unskipped_seconds = std::min(one.unskipped_seconds, timed(one, {.skip = false}, one.unskipped_hash));
    const auto& entries = profile.entries();
    const auto found = std::ranges::find(entries, one.stage, &StageProfile::Entry::stage);
    one.calls = found == entries.end() ? 0 : found->calls;
    one.stage_seconds = std::min(one.stage_seconds, found == entries.end() ? 0 : found->seconds);
}

Row row_of(const Case& one) {
    const double ms_per_frame = 1e3 * one.scene.time_step / one.scene.duration;
    Row row = one.key;
    for (const std::string& field :
         {one.stage, std::to_string(one.calls), measured_text(ms_per_frame * one.stage_seconds),
          measured_text(ms_per_frame * one.seconds), one.hash, measured_text(ms_per_frame * one.unskipped_seconds),
          one.unskipped_hash})
        row.push_back(field);
    return row;
}

}  // namespace

std::vector<std::string> stage_feature_names() {
    std::vector<std::string> names;
    for (const Feature& feature : features) names.emplace_back(feature.name);
    return names;
}

Row stage_cost_columns() {
    return fields(
        "feature,scheme,state,machine,stage,calls,stage_ms_per_frame,ms_per_frame,hash,"
        "unskipped_ms_per_frame,unskipped_hash");
}

void run_stage_cost_study(const StageCostStudy& study, ResultTable& table,
                          const std::function<void(const std::string&)>& report) {
    for (const std::string& name : study.features) {
        std::vector<Case> cases;
        for (const Scheme scheme : study.schemes)
            for (const std::string& state : study.states) {
                if (!find_feature(name).stage[scheme == Scheme::conserving]) continue;
                Case one = make_case(find_feature(name), scheme, state, study.quick);
                if (!table.has(one.key)) cases.push_back(std::move(one));
            }
        for (int repeat = 0; repeat < study.repeats; ++repeat)
            for (Case& one : cases) measure(one, study.skipped_only);
        for (const Case& one : cases) {
            table.add(row_of(one));
            report(joined(table.rows().back(), " "));
        }
    }
}

}  // namespace natator::bench
