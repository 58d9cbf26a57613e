#include "level_runs.h"

#include <functional>
#include <iostream>

#include "base/field.h"
#include "base/fnv1a.h"
#include "base/text.h"
#include "commit.h"
#include "natator/cost.h"
#include "natator/error.h"
#include "natator/instruction_set.h"
#include "natator/model.h"
#include "natator/version.h"
#include "scene/gait_json.h"
#include "scene/merge_patches.h"
#include "scene/scene_json.h"

namespace natator::cli {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

/// Of the runs that were stable.
std::vector<double> values(const LevelRuns& runs, const std::function<double(const json&)>& figure) {
    std::vector<double> all;
    for (const json& result : runs.results)
        if (result.at("status") == "ok") all.push_back(figure(result));
    return all;
}

/// Reads a level's request and refuses what would cost too much.
LevelRuns read_level(const Level& level, const json& request, const std::string& document,
                     const BackendChoice& backend) {
    const Job job = read_job(request, backend, document);
    LevelRuns runs{.level = level, .request = request, .job = job, .results = {}};
    refuse_gpu_options_for_cpu(runs.job.backend);
    if (!runs.job.scene.creature)
        throw InputError(document + ": scene " + natator::quoted(runs.job.request.scene) +
                         ": has no creature; must have one that swims");
    const Model model = build_model(runs.job.scene);
    check_gait(runs.job.gait, runs.job.scene.creature->actuators());
    check_evaluation_cost(runs.job.scene, model,
                          {.doubles = runs.job.request.precision == Precision::double_precision});
    runs.substeps = model.parameters.substeps;
    runs.particles = model.particles();
    runs.body_length = model.body.length;
    return runs;
}

/// None if there is no such level.
const LevelRuns* find_level(const std::vector<LevelRuns>& levels, const std::string& name) {
    for (const LevelRuns& runs : levels)
        if (runs.level.name == name) return &runs;
    return nullptr;
}

/// What determines the bits of a level's runs, but for the start.
json origin_of(const LevelRuns& runs) {
    const Request& request = runs.job.request;
    Fnv1a hash;
    hash.add(scene_definition(request.scene, request.overrides).dump());
    return {{"definition", hash_text(hash.value())},
            {"gait", gait_json(runs.job.gait)},
            {"precision", to_string(request.precision)},
            {"amplitude", request.perturbation.amplitude},  // 0: starts of the scene
            {"backend", on_gpu(runs.job.backend, runs.job.scene) ? "cuda" : "cpu"},
            {"wholeGpu", runs.job.backend.whole_gpu},
            {"version", NATATOR_VERSION},
            {"commit", commit()},
            {"instructionSet", to_string(instruction_set())}};
}

void say(const std::string& text) {
    std::cerr << "natator-sim: converge: " << text << std::endl;
}

}  // namespace

Sample LevelRuns::distance() const {
    return sample_of(values(*this, [](const json& result) { return result.at("distance").get<double>(); }));
}

Sample LevelRuns::speed() const {
    return sample_of(values(*this, [](const json& result) {
        const double simulated = result.at("simulated");
        return simulated > 0 ? result.at("distance").get<double>() / simulated : 0;
    }));
}

int LevelRuns::unstable_runs() const {
    return static_cast<int>(results.size() - values(*this, [](const json&) { return 0; }).size());
}

std::vector<LevelRuns> read_levels(json request, const std::string& document, const std::vector<std::string>& names,
                                   const BackendChoice& backend) {
    if (!request.is_object()) fields::refuse({document, ""}, request, "an object");
    if (request.contains("start"))
        throw InputError(document + ": start: must not be given, converge has starts of its own");
    if (fields::has(request, "perturbation") && request["perturbation"].is_object() &&
        !request["perturbation"].contains("seed"))
        request["perturbation"]["seed"] = 1u;  // only its amplitude counts, converge has seeds of its own
    std::vector<LevelRuns> levels{read_level(Level::named("base"), request, document, backend)};
    const Perturbation perturbation = levels.front().job.request.perturbation;
    if (fields::has(request, "perturbation") && perturbation.amplitude == 0)
        throw InputError(document + ": perturbation.amplitude = 0: must be above 0, without it starts are the scene's");
    const Scene scene = levels.front().job.scene;
    request.erase("perturbation");
    levels.front().request = request;
    for (const std::string& name : names) {
        const Level level = Level::named(name);
        json finer = request;
        const json own = request.contains("overrides") ? request.at("overrides") : json::object();
        finer["overrides"] = merge_patches(own, refined(scene, level, levels.front().substeps));
        levels.push_back(read_level(level, finer, document, backend));
        levels.back().job.request.perturbation = perturbation;
    }
    return levels;
}

void run_level(LevelRuns& runs, int starts, const Execution& execution, RunRecord& record) {
    const json origin = origin_of(runs);
    runs.results.assign(starts, nullptr);
    std::vector<int> missing;
    const auto of = [&](int k) {
        json all = origin;
        all["seed"] = k + 1;
        return all;
    };
    for (int k = 0; k < starts; ++k) {
        runs.results[k] = record.find(of(k));
        if (runs.results[k].is_null()) missing.push_back(k);
    }
    /// From start k: perturbed if the request asks for it, else as its `start` has it.
    const auto job_of = [&](int k) {
        Job job = runs.job;
        Perturbation& perturbation = job.request.perturbation;
        if (perturbation.amplitude > 0)
            perturbation.seed = k + 1;
        else
            perturbation = choose_start(k + 1, job.scene);
        return job;
    };
    const int found = starts - static_cast<int>(missing.size());
    if (found > 0) say(runs.level.name + ": " + std::to_string(found) + " runs are recorded");
    const auto note = [&](int k, const Evaluation& evaluation) {
        json request = runs.request;
        if (const double amplitude = runs.job.request.perturbation.amplitude; amplitude > 0)
            request["perturbation"] = {{"amplitude", amplitude}, {"seed", k + 1}};
        else
            request["start"] = k + 1;
        const ordered_json result =
            result_json(request.at("id"), evaluation, runs.job.scene.scheme, runs.job.request.precision);
        record.add(of(k), request, result);
        runs.results[k] = json::parse(result.dump());
    };
    if (missing.empty()) return;
    if (on_gpu(runs.job.backend, runs.job.scene)) {
        say(runs.level.name + ": " + std::to_string(missing.size()) + " runs together");
        std::vector<BatchMember> members;
        for (const int k : missing) members.push_back(member_of(job_of(k)));
        const std::vector<Evaluation> evaluations = evaluate_on_gpu(
            runs.job.scene, members, batch_options(runs.job.request.precision, runs.job.backend, execution));
        for (std::size_t i = 0; i < missing.size(); ++i) note(missing[i], evaluations[i]);
        return;
    }
    for (const int k : missing) {
        note(k, evaluate_job(job_of(k), execution));
        const json& distance = runs.results[k].at("distance");
        say(runs.level.name + ": run " + std::to_string(k + 1) + " of " + std::to_string(starts) +
            (distance.is_null() ? ", unstable" : ", distance " + figure_text(distance.get<double>())));
    }
}

std::optional<Estimate> estimate_speed(const std::vector<LevelRuns>& levels) {
    const auto speed = [&](const char* name) -> std::optional<Sample> {
        const LevelRuns* runs = find_level(levels, name);
        return runs && runs->speed().runs > 0 ? std::optional(runs->speed()) : std::nullopt;
    };
    const std::optional<Sample> base = speed("base"), half = speed("time/2");
    if (!base) return std::nullopt;
    return estimate_of(*base, half, half ? speed("time/4") : std::nullopt, speed("spacing/2"),
                       levels.front().job.scene.scheme == Scheme::lattice);
}

}  // namespace natator::cli
