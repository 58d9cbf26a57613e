#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iomanip>
#include <iostream>
#include <memory>
#include <sstream>

#include "commands.h"
#include "commit.h"
#include "converge/estimate.h"
#include "converge/level.h"
#include "io/strict_json.h"
#include "job.h"
#include "json_argument.h"
#include "measure/fnv1a.h"
#include "natator/actuate.h"
#include "natator/cost.h"
#include "natator/error.h"
#include "natator/instruction_set.h"
#include "natator/model_builder.h"
#include "natator/version.h"
#include "options.h"
#include "run_record.h"
#include "scene/field.h"
#include "scene/merge_patches.h"
#include "scene/scene_json.h"

namespace natator::cli {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr double usual_perturbation = 1e-3;  // of the fluid's rest distance

struct ConvergeOptions {
    std::string request, output;
    std::vector<std::string> levels{"time/2", "spacing/2"};
    int starts = 8;
    bool plain = false;
    BackendChoice backend;
    ExecutionOptions execution;
};

/// A level's scene, and what its runs gave.
struct LevelRuns {
    Level level;
    json request;  ///< without a perturbation
    Job job;
    int substeps = 0, particles = 0;
    double body_length = 0;
    std::vector<json> results;

    /// Of the runs that were stable.
    std::vector<double> values(const std::function<double(const json&)>& figure) const {
        std::vector<double> all;
        for (const json& result : results)
            if (result.at("status") == "ok") all.push_back(figure(result));
        return all;
    }
    Sample distance() const {
        return sample_of(values([](const json& result) { return result.at("distance").get<double>(); }));
    }
    Sample speed() const {
        return sample_of(values([](const json& result) {
            const double simulated = result.at("simulated");
            return simulated > 0 ? result.at("distance").get<double>() / simulated : 0;
        }));
    }
    int unstable_runs() const { return static_cast<int>(results.size() - values([](const json&) { return 0; }).size()); }
};

/// Reads a level's request and refuses what would cost too much.
LevelRuns read_level(const Level& level, const json& request, const ConvergeOptions& options) {
    const std::string document = request_name(options.request);
    const Job job = read_job(request, options.backend, document);
    LevelRuns runs{.level = level, .request = request, .job = job, .results = {}};
    refuse_gpu_options_for_cpu(runs.job.backend);
    if (!runs.job.scene.creature)
        throw InputError(document + ": scene " + natator::quoted(runs.job.request.scene) + ": has no creature; must have one that swims");
    const Model model = build_model(runs.job.scene);
    check_gait(runs.job.gait, runs.job.scene.creature->actuators());
    check_evaluation_cost(runs.job.scene, model);
    runs.substeps = model.parameters.substeps;
    runs.particles = model.particles();
    runs.body_length = model.body.length;
    return runs;
}

const LevelRuns* find_level(const std::vector<LevelRuns>& levels, const std::string& name) {
    for (const LevelRuns& runs : levels)
        if (runs.level.name == name) return &runs;
    return nullptr;
}

std::vector<LevelRuns> read_levels(json request, const ConvergeOptions& options) {
    const std::string document = request_name(options.request);
    if (!request.is_object()) fields::refuse({document, ""}, request, "an object");
    if (request.contains("start")) throw InputError(document + ": start: must not be given, converge has starts of its own");
    if (fields::has(request, "perturbation") && request["perturbation"].is_object() && !request["perturbation"].contains("seed"))
        request["perturbation"]["seed"] = 1u;  // only its amplitude counts, converge has seeds of its own
    std::vector<LevelRuns> levels{read_level(Level::named("base"), request, options)};
    Perturbation perturbation = levels.front().job.request.perturbation;
    const Scene scene = levels.front().job.scene;
    if (perturbation.amplitude == 0) perturbation.amplitude = usual_perturbation * scene.solver.fluidRestDistance;
    levels.front().job.request.perturbation = perturbation;
    request.erase("perturbation");
    levels.front().request = request;
    for (const std::string& name : options.levels) {
        const Level level = Level::named(name);
        json finer = request;
        const json own = request.contains("overrides") ? request.at("overrides") : json::object();
        finer["overrides"] = merge_patches(own, refined(scene, level, levels.front().substeps));
        levels.push_back(read_level(level, finer, options));
        levels.back().job.request.perturbation = perturbation;
    }
    return levels;
}

/// What determines the bits of a level's runs, but for the start.
json origin_of(const LevelRuns& runs) {
    const Request& request = runs.job.request;
    Fnv1a hash;
    hash.add(scene_definition(request.scene, request.overrides).dump());
    return {{"definition", hash_text(hash.value())},
            {"gait", gait_json(runs.job.gait)},
            {"precision", to_string(request.precision)},
            {"amplitude", request.perturbation.amplitude},
            {"backend", on_gpu(runs.job.backend, runs.job.scene) ? "cuda" : "cpu"},
            {"wholeGpu", runs.job.backend.whole_gpu},
            {"version", NATATOR_VERSION},
            {"commit", commit()},
            {"instructionSet", to_string(instruction_set())}};
}

void say(const std::string& text) { std::cerr << "natator-sim: converge: " << text << std::endl; }

/// Does the runs of a level that are not recorded, and records them.
void run_level(LevelRuns& runs, const ConvergeOptions& options, const Execution& execution, RunRecord& record) {
    const json origin = origin_of(runs);
    runs.results.assign(options.starts, nullptr);
    std::vector<int> missing;
    const auto of = [&](int k) {
        json all = origin;
        all["seed"] = k + 1;
        return all;
    };
    for (int k = 0; k < options.starts; ++k) {
        runs.results[k] = record.find(of(k));
        if (runs.results[k].is_null()) missing.push_back(k);
    }
    const int found = options.starts - static_cast<int>(missing.size());
    if (found > 0) say(runs.level.name + ": " + std::to_string(found) + " runs are recorded");
    const auto note = [&](int k, const Evaluation& evaluation) {
        json request = runs.request;
        request["perturbation"] = {{"amplitude", runs.job.request.perturbation.amplitude}, {"seed", k + 1}};
        const ordered_json result =
            result_json(request.at("id"), evaluation, runs.job.scene.scheme, runs.job.request.precision);
        record.add(of(k), request, result);
        runs.results[k] = json::parse(result.dump());
    };
    const auto perturbation = [&](int k) {
        return Perturbation{runs.job.request.perturbation.amplitude, static_cast<std::uint64_t>(k + 1)};
    };
    if (missing.empty()) return;
    if (on_gpu(runs.job.backend, runs.job.scene)) {
        say(runs.level.name + ": " + std::to_string(missing.size()) + " runs together");
        std::vector<BatchMember> members;
        for (const int k : missing) members.push_back({runs.job.gait, perturbation(k)});
        const std::vector<Evaluation> evaluations = evaluate_on_gpu(
            runs.job.scene, members, batch_options(runs.job.request.precision, runs.job.backend));
        for (std::size_t i = 0; i < missing.size(); ++i) note(missing[i], evaluations[i]);
        return;
    }
    for (const int k : missing) {
        Job job = runs.job;
        job.request.perturbation = perturbation(k);
        note(k, evaluate_job(job, execution));
        const json& distance = runs.results[k].at("distance");
        say(runs.level.name + ": run " + std::to_string(k + 1) + " of " + std::to_string(options.starts) +
            (distance.is_null() ? ", unstable" : ", distance " + figure_text(distance.get<double>())));
    }
}

/// None if no run as asked for was stable.
std::optional<Estimate> estimate_speed(const std::vector<LevelRuns>& levels) {
    const auto speed = [&](const char* name) -> std::optional<Sample> {
        const LevelRuns* runs = find_level(levels, name);
        return runs && runs->speed().runs > 0 ? std::optional(runs->speed()) : std::nullopt;
    };
    const std::optional<Sample> base = speed("base"), half = speed("time/2");
    if (!base) return std::nullopt;
    return estimate_of(*base, half, half ? speed("time/4") : std::nullopt, speed("spacing/2"));
}

ordered_json sample_json(const Sample& sample) { return {{"mean", sample.mean}, {"error", sample.error}}; }

ordered_json limit_json(const Limit& limit) {
    return {{"order", limit.order}, {"observed", limit.observed}, {"change", limit.from_base}};
}

ordered_json convergence_json(const std::vector<LevelRuns>& levels, const std::optional<Estimate>& estimate) {
    ordered_json result;
    const LevelRuns& base = levels.front();
    result["id"] = base.request.at("id");
    result["scheme"] = to_string(base.job.scene.scheme);
    result["precision"] = to_string(base.job.request.precision);
    result["perturbation"] = base.job.request.perturbation.amplitude;
    result["bodyLength"] = base.body_length;
    for (const LevelRuns& runs : levels) {
        ordered_json level;
        level["level"] = runs.level.name;
        level["substeps"] = runs.substeps;
        level["particles"] = runs.particles;
        level["fluidRestDistance"] = runs.job.scene.solver.fluidRestDistance;
        level["runs"] = runs.distance().runs;
        level["unstable"] = runs.unstable_runs();
        if (runs.distance().runs > 0) {
            level["distance"] = sample_json(runs.distance());
            level["speed"] = sample_json(runs.speed());
            if (const auto change = relative_change(base.speed(), runs.speed()); change && &runs != &base)
                level["change"] = sample_json(*change);
        }
        ordered_json stopped = ordered_json::object();
        for (const json& one : runs.results) {
            const std::string reason = one.at("stopped");
            stopped[reason] = stopped.value(reason, 0) + 1;
        }
        level["stopped"] = stopped;
        result["levels"].push_back(level);
    }
    if (!estimate) return result;
    ordered_json speed = {{"speed", estimate->value},
                          {"error", estimate->error},
                          {"statistical", estimate->statistical},
                          {"discretisation", estimate->discretisation}};
    if (estimate->time) speed["time"] = limit_json(*estimate->time);
    if (estimate->space) speed["spacing"] = limit_json(*estimate->space);
    result["estimate"] = speed;
    return result;
}

/// With as many digits as the error has meaning for: two of it.
std::string with_error(double value, double error) {
    std::ostringstream text;
    const int digits = error > 0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(error))), 0, 9) : 4;
    text << std::fixed << std::setprecision(digits) << value << " +- " << error;
    return text.str();
}

std::string order_text(const char* what, const std::optional<Limit>& limit) {
    if (!limit) return "";
    std::ostringstream text;
    text << ", order " << std::setprecision(3) << limit->order << (limit->observed ? " seen" : " assumed") << " in the "
         << what;
    return text.str();
}

std::string convergence_table(const std::vector<LevelRuns>& levels, const std::optional<Estimate>& estimate) {
    std::ostringstream text;
    const auto row = [&](const std::string& level, const std::string& substeps, const std::string& particles,
                         const std::string& runs, const std::string& distance, const std::string& speed,
                         const std::string& change) {
        std::ostringstream line;
        line << std::left << std::setw(11) << level << std::right << std::setw(8) << substeps << std::setw(11)
             << particles << std::setw(6) << runs << "   " << std::left << std::setw(24) << distance << "  " << std::setw(24)
             << speed << "  " << change;
        std::string all = line.str();
        all.erase(all.find_last_not_of(' ') + 1);
        text << all << "\n";
    };
    row("level", "substeps", "particles", "runs", "distance", "speed", "change of speed");
    for (const LevelRuns& runs : levels) {
        const Sample distance = runs.distance(), speed = runs.speed();
        const auto change = relative_change(levels.front().speed(), speed);
        const bool any = distance.runs > 0;
        row(runs.level.name, std::to_string(runs.substeps), std::to_string(runs.particles), std::to_string(distance.runs),
            any ? with_error(distance.mean, distance.error) : "unstable", any ? with_error(speed.mean, speed.error) : "",
            any && change && &runs != &levels.front() ? with_error(100 * change->mean, 100 * change->error) + " %" : "");
    }
    if (estimate)
        text << "speed at time step and spacing 0: " << with_error(estimate->value, estimate->error)
             << " length/s (scatter " << std::setprecision(2) << estimate->statistical << ", discretisation "
             << estimate->discretisation << order_text("time step", estimate->time)
             << order_text("spacing", estimate->space) << ")\n";
    for (const LevelRuns& runs : levels)
        if (runs.unstable_runs() > 0)
            text << runs.level.name << ": " << runs.unstable_runs() << " runs were unstable and are left out\n";
    return text.str();
}

int run_converge(ConvergeOptions& options) {
    RunRecord record(options.output);
    std::vector<LevelRuns> levels = read_levels(read_request(options.request), options);
    bool all_stable = true;
    for (LevelRuns& runs : levels) {
        run_level(runs, options, options.execution.execution(), record);
        all_stable = all_stable && runs.unstable_runs() == 0;
    }
    const std::optional<Estimate> estimate = estimate_speed(levels);
    const std::string table = convergence_table(levels, estimate);
    if (options.plain) {
        print(table);
    } else {
        std::cerr << table;
        print(convergence_json(levels, estimate).dump() + "\n");
    }
    return all_stable ? ok : unstable;
}

}  // namespace

void add_converge(CLI::App& app, int& status) {
    CLI::App* command = app.add_subcommand(
        "converge",
        "The same swim from several perturbed starts, as asked for, at half the time step and at half the spacing of the "
        "particles: how far its speed depends on them, and what it goes to. One JSON object on standard output, a table "
        "on standard error.");
    const auto options = std::make_shared<ConvergeOptions>();
    command->add_option("request", options->request,
                        "File or JSON text: a request as for `evaluate`; its perturbation gives the amplitude of the "
                        "starts, else they are perturbed by 0.001 of fluidRestDistance. Default, and -: standard input.");
    command->add_option("--starts", options->starts, "Perturbed starts: seeds 1 to this.")
        ->check(whole_number_in(2, 1000))
        ->capture_default_str();
    command->add_option("--levels", options->levels, "Of time/2, time/4, spacing/2 and both/2, beside the base.")
        ->delimiter(',')
        ->check(one_of({"time/2", "time/4", "spacing/2", "both/2"}))
        ->default_str("time/2,spacing/2");
    command->add_option("--output", options->output,
                        "File that gets a line for each run at its end; runs that it holds already are not done again.");
    command->add_flag("--plain", options->plain, "Write the table to standard output instead of JSON.");
    add_backend_options(command, options->backend);
    add_execution_options(command, options->execution);
    refuse_repeated_values(*command);
    command->callback([options, &status] { status = run_converge(*options); });
}

}  // namespace natator::cli
